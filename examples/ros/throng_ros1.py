"""A ROS 1 node for a flight of `throng live`: its topics, commands and services by the names of docs/robotics.md.

python3 throng_ros1.py [ws://localhost:8765] [_sim_time:=false]

Debian: python3-rospy, python3-websocket and packages of messages (python3-sensor-msgs and others, as imported).
/use_sim_time is set, since /clock is the flight's time: start this node before those that use the flight. Channels other
than /clock, /tf and /DRONE/mode are read while their topic has subscribers, so images are drawn while somebody looks.
Points of commands are in the frame `world`, whatever their header says. The exit status is 0 when the flight has ended,
1 when the connection was lost.
"""

from __future__ import annotations

import argparse
import functools
import json
import math
import re
import struct
import sys
import threading
import weakref
from typing import Any, Callable

import genpy
import roslib.message
import rospy
from geometry_msgs.msg import PoseStamped, Quaternion, Twist
from nav_msgs.msg import Path
from std_msgs.msg import Bool
from std_srvs.srv import Trigger, TriggerRequest, TriggerResponse

from foxglove_client import DEFAULT_URL, Channel, FoxgloveClient

POLL_S = 0.1  # between looks at the numbers of subscribers
ANSWER_S = 5  # for answers to callers of services when the flight has ended
QUEUED = 1000  # messages of a topic by which a subscriber may lag behind

NUMBERS = dict(zip("bool int8 uint8 int16 uint16 int32 uint32 int64 uint64 float32 float64".split(), "?bBhHiIqQfd"))
TIMES = {"builtin_interfaces/Time": genpy.Time, "builtin_interfaces/Duration": genpy.Duration}


class Decoder:
    """Turns messages of ROS 2 in CDR into those of ROS 1, by the definition that the server sends.

    Fields that ROS 1 does not have are passed over (Marker's texture), others keep their defaults (Header's seq).
    """

    FIELD = re.compile(r"^([\w/]+)(?:(\[)(\d*)\])? (\w+)$", re.MULTILINE)

    def __init__(self, schema_name: str, schema: str) -> None:
        self.name = schema_name.replace("/msg/", "/")
        parts = re.split(r"^=+\nMSG: (.*)\n", schema, flags=re.MULTILINE)
        definitions = dict(zip([self.name, *parts[1::2]], parts[0::2]))
        self.fields = {name: self.FIELD.findall(definition) for name, definition in definitions.items()}
        self.classes = {name: roslib.message.get_message_class(name) for name in definitions}

    def decode(self, data: bytes) -> genpy.Message:
        if data[:2] != b"\0\1":
            raise ValueError(f"{self.name}: found the encapsulation {data[:2].hex()}, expected 0001: little-endian CDR")
        self.data, self.at = data[4:], 0
        return self._message(self.name)

    def _message(self, kind: str) -> Any:
        """The next message; None if ROS 1 does not have its class."""
        if kind in TIMES:
            return TIMES[kind](self._value("int32"), self._value("uint32"))
        message = self.classes[kind]() if self.classes[kind] else None
        slots = {slot.lower(): slot for slot in getattr(message, "__slots__", ())}  # CameraInfo has D, K, R and P
        for field_kind, is_array, count, name in self.fields[kind]:
            value = self._array(field_kind, count) if is_array else self._value(field_kind)
            if name in slots:
                setattr(message, slots[name], value)
        return message

    def _array(self, kind: str, count: str) -> Any:
        size = int(count or self._value("uint32"))
        if kind == "uint8":
            return self._take(size)
        return self._numbers(kind, size) if kind in NUMBERS else [self._value(kind) for _ in range(size)]

    def _value(self, kind: str) -> Any:
        if kind == "string":
            return self._take(self._value("uint32"))[:-1].decode()
        return self._numbers(kind, 1)[0] if kind in NUMBERS else self._message(kind)

    def _numbers(self, kind: str, count: int) -> tuple[Any, ...]:
        layout = f"<{count}{NUMBERS[kind]}"
        if count:  # nothing is aligned for an empty sequence
            self.at += -self.at % struct.calcsize(NUMBERS[kind])
        return struct.unpack(layout, self._take(struct.calcsize(layout)))

    def _take(self, size: int) -> bytes:
        self.at += size
        return self.data[self.at - size : self.at]


def numbers(value: genpy.Message) -> dict[str, float]:
    """The fields of a Vector3, Point or Quaternion."""
    return {name: getattr(value, name) for name in value.__slots__}


def pose_command(message: PoseStamped) -> dict[str, Any]:
    """Without an orientation if that is all zeros, as in a new message of ROS 1: the heading stays as it is."""
    command = {"position": numbers(message.pose.position), "orientation": numbers(message.pose.orientation)}
    return command if any(command["orientation"].values()) else {"position": command["position"]}


def path_command(message: Path) -> dict[str, Any]:
    poses = [stamped.pose for stamped in message.poses]
    command: dict[str, Any] = {"waypoints": [list(numbers(pose.position).values()) for pose in poses]}
    if poses and any(numbers(poses[-1].orientation).values()):
        q = poses[-1].orientation
        command["yaw_deg"] = math.degrees(math.atan2(2 * (q.w * q.z + q.x * q.y), 1 - 2 * (q.y * q.y + q.z * q.z)))
    return command


# Class and JSON of each command, by its topic below the drone's name.
COMMANDS: dict[str, tuple[Any, Callable[[Any], dict[str, Any]]]] = {
    "cmd_vel": (Twist, lambda twist: {"linear": numbers(twist.linear), "angular": numbers(twist.angular)}),
    "cmd_pose": (PoseStamped, pose_command),
    "cmd_waypoints": (Path, path_command),
    "gimbal": (Quaternion, lambda quaternion: {"orientation": numbers(quaternion)}),
    "beacon": (Bool, lambda message: {"data": message.data}),
}


class Node:
    """Publishers, subscribers and services for everything that the server has."""

    def __init__(self, client: FoxgloveClient) -> None:
        self.client = client
        self.decoders = {topic: Decoder(each.schema_name, each.schema) for topic, each in client.channels.items()}
        self.publishers: dict[str, rospy.Publisher] = {}  # by topic, too
        self.answering: weakref.WeakSet[threading.Thread] = weakref.WeakSet()
        for topic, decoder in self.decoders.items():
            message_class = decoder.classes[decoder.name]
            if message_class is None or decoder.name.startswith("vision_msgs/"):  # ROS 1 has others by these names
                rospy.loginfo("%s is not published: ROS 1 does not have this %s", topic, decoder.name)
                continue
            latch = topic.endswith("/mode")
            self.publishers[topic] = rospy.Publisher(topic, message_class, queue_size=QUEUED, latch=latch)
        self.always = {topic for topic in self.publishers if topic in ("/clock", "/tf") or topic.endswith("/mode")}
        for drone in client.drones():
            for name, (message_class, to_json) in COMMANDS.items():
                topic = f"/{drone}/{name}"
                rospy.Subscriber(topic, message_class, functools.partial(self.command, topic, to_json))
        for service in client.services:
            rospy.Service(service, Trigger, functools.partial(self.call, service))

    def follow_subscribers(self) -> None:
        watched = {topic for topic, publisher in self.publishers.items() if publisher.get_num_connections() > 0}
        self.client.subscribe_to(watched | self.always)

    def publish(self, channel: Channel, data: bytes) -> None:
        self.publishers[channel.topic].publish(self.decoders[channel.topic].decode(data))

    def command(self, topic: str, to_json: Callable[[Any], dict[str, Any]], message: Any) -> None:
        self.client.publish(topic, json.dumps(to_json(message)).encode())

    def call(self, service: str, _: TriggerRequest) -> TriggerResponse:
        self.answering.add(threading.current_thread())
        return TriggerResponse(*self.client.call(service))


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("url", nargs="?", default=DEFAULT_URL)
    url = parser.parse_args(rospy.myargv()[1:]).url
    rospy.init_node("throng")
    try:
        client = FoxgloveClient(url)
    except ConnectionError as error:
        rospy.logfatal("%s", error)
        return 1
    if rospy.get_param("~sim_time", True):
        rospy.set_param("/use_sim_time", True)
    node = Node(client)
    client.start(node.publish, lambda level, text: (rospy.loginfo, rospy.logwarn, rospy.logerr)[level]("%s", text))
    rospy.on_shutdown(client.close)  # before rospy closes the publishers
    while not rospy.is_shutdown() and not client.wait(POLL_S):
        node.follow_subscribers()
    if rospy.is_shutdown():
        return 0
    for thread in list(node.answering):  # such as that of /throng/stop, whose caller waits
        thread.join(ANSWER_S)
    if client.problem:
        rospy.logfatal("the connection to %s was lost: %s", url, client.problem)
        return 1
    rospy.loginfo("the flight has ended, and with it this node")
    return 0


if __name__ == "__main__":
    sys.exit(main())
