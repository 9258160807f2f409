#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""start, hold, resume, return, land and stop of a vehicle as services (std_srvs/Trigger).

Each call is one `foretrack order`, so that leases, answers and refusals are those of every operator.

    ros2 service call /uav1/mission/start std_srvs/srv/Trigger
"""
import subprocess

import rclpy
from rclpy.node import Node
from std_srvs.srv import Trigger

ORDERS = ("start", "hold", "resume", "return", "land", "stop")
PATIENCE_S = 20.0


class MissionServices(Node):
    def __init__(self):
        super().__init__("mission")
        vehicle = self.declare_parameter("vehicle", "uav1").value
        interface = self.declare_parameter("interface", "").value
        options = ["--vehicle", vehicle, *(["--interface", interface] if interface else [])]
        for order in ORDERS:
            self.create_service(Trigger, f"~/{order}", self.answer_to(["foretrack", "order", order, *options]))

    def answer_to(self, words):
        def answer(_request, response):
            try:
                done = subprocess.run(words, capture_output=True, text=True, timeout=PATIENCE_S,
                                      check=False)
                response.success = done.returncode == 0
                response.message = (done.stdout + done.stderr).strip()
            except (OSError, subprocess.TimeoutExpired) as error:
                response.success = False
                response.message = str(error)
            return response
        return answer


def main():
    rclpy.init()
    node = MissionServices()
    try:
        rclpy.spin(node)
    except KeyboardInterrupt:
        pass
    finally:
        node.destroy_node()
        rclpy.try_shutdown()


if __name__ == "__main__":
    main()
