"""A ROS 2 node for a flight of `throng live`: its topics, commands and services by the names of docs/robotics.md.

python3 throng_ros2.py [ws://localhost:8765]

It is untested: ROS 2 is not in Debian. It was written by the sources of rclpy (Humble to Rolling) and has run with
stand-ins for it only. It needs rclpy, rosidl_runtime_py, std_srvs, the packages of the messages and websocket-client
(python3-websocket). Messages pass as they are, in CDR. Channels other than /clock, /tf and /DRONE/mode are read while their
topic has subscribers, so images are drawn while somebody looks. /clock is the flight's time: start the nodes that use the
flight with `--ros-args -p use_sim_time:=true`. Points of commands are in the frame `world`, whatever their header says. The
exit status is 0 when the flight has ended, 1 when the connection was lost.
"""

from __future__ import annotations

import argparse
import functools
import sys

import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.logging import get_logger
from rclpy.node import Node
from rclpy.publisher import Publisher
from rclpy.qos import DurabilityPolicy, QoSProfile
from rclpy.utilities import remove_ros_args, try_shutdown
from rosidl_runtime_py.utilities import get_message
from std_srvs.srv import Trigger

from foxglove_client import DEFAULT_URL, Channel, FoxgloveClient

POLL_S = 0.1  # between looks at the numbers of subscribers

# Reliable, which subscribers with the quality of sensors (best effort) take as well.
QUALITY = QoSProfile(depth=100)
LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)

# Type of each command, by its topic below the drone's name.
COMMANDS = {
    "cmd_vel": "geometry_msgs/msg/Twist",
    "cmd_pose": "geometry_msgs/msg/PoseStamped",
    "cmd_waypoints": "nav_msgs/msg/Path",
    "gimbal": "geometry_msgs/msg/Quaternion",
    "beacon": "std_msgs/msg/Bool",
}


class ThrongNode(Node):
    """Publishers, subscribers and services for everything that the server has."""

    def __init__(self, client: FoxgloveClient) -> None:
        super().__init__("throng")
        self.client = client
        self.topics: dict[str, Publisher] = {}
        for topic, channel in client.channels.items():
            try:
                message_class = get_message(channel.schema_name)
            except (ImportError, AttributeError):
                self.get_logger().info(f"{topic} is not published: {channel.schema_name} is not installed")
                continue
            quality = LATCHED if topic.endswith("/mode") else QUALITY
            self.topics[topic] = self.create_publisher(message_class, topic, quality)
        self.always = {topic for topic in self.topics if topic in ("/clock", "/tf") or topic.endswith("/mode")}
        for drone in client.drones():
            for name, schema_name in COMMANDS.items():
                topic = f"/{drone}/{name}"
                forward = functools.partial(client.publish, topic, encoding="cdr", schema_name=schema_name)
                self.create_subscription(get_message(schema_name), topic, forward, QUALITY, raw=True)
        for service in client.services:
            self.create_service(Trigger, service, functools.partial(self.call, service))

    def follow_subscribers(self) -> None:
        watched = {topic for topic, publisher in self.topics.items() if publisher.get_subscription_count() > 0}
        self.client.subscribe_to(watched | self.always)

    def publish(self, channel: Channel, data: bytes) -> None:
        try:
            self.topics[channel.topic].publish(data)
        except Exception:
            if rclpy.ok():
                raise

    def call(self, service: str, _: Trigger.Request, response: Trigger.Response) -> Trigger.Response:
        response.success, response.message = self.client.call(service)
        return response

    def log(self, level: int, text: str) -> None:
        # A line of the source logs at one severity only: rclpy sees to it.
        if level == 0:
            self.get_logger().info(text)
        elif level == 1:
            self.get_logger().warning(text)
        else:
            self.get_logger().error(text)


def fly(url: str) -> int:
    logger = get_logger("throng")
    try:
        client = FoxgloveClient(url)
    except ConnectionError as error:
        logger.fatal(str(error))
        return 1
    node = ThrongNode(client)
    client.start(node.publish, node.log)
    while rclpy.ok() and not client.wait(0):
        rclpy.spin_once(node, timeout_sec=POLL_S)
        node.follow_subscribers()
    if rclpy.ok() and client.problem:
        logger.fatal(f"the connection to {url} was lost: {client.problem}")
        return 1
    if rclpy.ok():
        logger.info("the flight has ended, and with it this node")
    return 0


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("url", nargs="?", default=DEFAULT_URL)
    url = parser.parse_args(remove_ros_args()[1:]).url
    rclpy.init()
    try:
        return fly(url)
    except (KeyboardInterrupt, ExternalShutdownException):
        return 0
    finally:
        try_shutdown()


if __name__ == "__main__":
    sys.exit(main())
