# SPDX-License-Identifier: Apache-2.0
"""The vehicle's services (`foretrack onboard`), and start, hold and land as services of ROS 2.

    ros2 launch foretrack_bringup onboard.launch.py vehicle:=uav1 config:=/etc/foretrack/uav1.yaml
    ros2 launch foretrack_bringup onboard.launch.py preset:=realsense remaps:='odometry:=odom'
"""
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, ExecuteProcess, OpaqueFunction
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node

ARGUMENTS = {
    "vehicle": ("uav1", "its name, which is the namespace of its topics"),
    "config": ("", "the vehicle's own file (docs/install.md)"),
    "params": ("", "differences from the default parameters (`foretrack params`)"),
    "preset": ("", "topics of a usual driver: realsense, oak, zed, …"),
    "remaps": ("", "NAME:=TOPIC, several with spaces between them"),
    "use_sim_time": ("false", "the time comes from /clock"),
    "interface": ("", "of the network; without it only this machine is heard"),
    "record": ("true", "flights are recorded, without pictures (docs/privacy.md)"),
}


def start(context):
    value = {name: LaunchConfiguration(name).perform(context) for name in ARGUMENTS}
    words = ["foretrack", "onboard", "--vehicle", value["vehicle"]]
    for option in ("config", "params", "preset", "interface"):
        if value[option]:
            words += [f"--{option}", value[option]]
    for remap in value["remaps"].split():
        words += ["--remap", remap]
    if value["use_sim_time"].lower() == "true":
        words.append("--use-sim-time")
    if value["record"].lower() != "true":
        words.append("--no-record")
    return [ExecuteProcess(cmd=words, output="screen"),
            Node(package="foretrack_bringup", executable="mission_services.py", name="mission",
                 namespace=value["vehicle"], output="screen",
                 parameters=[{"vehicle": value["vehicle"], "interface": value["interface"]}])]


def generate_launch_description():
    declared = [DeclareLaunchArgument(name, default_value=default, description=meaning)
                for name, (default, meaning) in ARGUMENTS.items()]
    return LaunchDescription([*declared, OpaqueFunction(function=start)])
