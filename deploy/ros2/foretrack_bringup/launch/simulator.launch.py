# SPDX-License-Identifier: Apache-2.0
"""A simulated vehicle, person and world, which publish sensors and /clock (`foretrack simulator`).

    ros2 launch foretrack_bringup simulator.launch.py scenario:=street_blocks
    ros2 launch foretrack_bringup onboard.launch.py use_sim_time:=true
"""
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, ExecuteProcess, OpaqueFunction
from launch.substitutions import LaunchConfiguration

ARGUMENTS = {
    "vehicle": ("uav1", "its name, which is the namespace of its topics"),
    "scenario": ("t_intersection", "a shipped one (`foretrack scenarios`) or a file"),
    "speed": ("1.0", "simulated seconds in a second"),
    "clock_topic": ("clock", "of several simulators, each needs one of its own"),
}


def start(context):
    value = {name: LaunchConfiguration(name).perform(context) for name in ARGUMENTS}
    return [ExecuteProcess(output="screen", cmd=[
        "foretrack", "simulator", "--endless", "--vehicle", value["vehicle"], "--scenario",
        value["scenario"], "--speed", value["speed"], "--clock-topic", value["clock_topic"]])]


def generate_launch_description():
    declared = [DeclareLaunchArgument(name, default_value=default, description=meaning)
                for name, (default, meaning) in ARGUMENTS.items()]
    return LaunchDescription([*declared, OpaqueFunction(function=start)])
