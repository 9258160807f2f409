# SPDX-License-Identifier: Apache-2.0
"""The ground station (`foretrack station`), and RViz if it is wanted.

    ros2 launch foretrack_bringup station.launch.py rviz:=true
"""
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, ExecuteProcess, OpaqueFunction
from launch.substitutions import LaunchConfiguration, PathJoinSubstitution
from launch_ros.actions import Node
from launch_ros.substitutions import FindPackageShare

ARGUMENTS = {
    "port": ("8080", "of the page, on this machine"),
    "control": ("false", "operators with a token may give orders"),
    "interface": ("", "of the network; without it only this machine is heard"),
    "rviz": ("false", "RViz with this package's layout, for the vehicle uav1"),
}


def start(context):
    value = {name: LaunchConfiguration(name).perform(context) for name in ARGUMENTS}
    words = ["foretrack", "station", "--port", value["port"]]
    if value["interface"]:
        words += ["--interface", value["interface"]]
    if value["control"].lower() == "true":
        words.append("--enable-control")
    actions = [ExecuteProcess(cmd=words, output="screen")]
    if value["rviz"].lower() == "true":
        layout = PathJoinSubstitution([FindPackageShare("foretrack_bringup"), "rviz",
                                       "foretrack.rviz"])
        actions.append(Node(package="rviz2", executable="rviz2", arguments=["-d", layout]))
    return actions


def generate_launch_description():
    declared = [DeclareLaunchArgument(name, default_value=default, description=meaning)
                for name, (default, meaning) in ARGUMENTS.items()]
    return LaunchDescription([*declared, OpaqueFunction(function=start)])
