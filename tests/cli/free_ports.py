"""Ports for servers that cannot choose one themselves, or that come back at the same one."""
import pathlib
import random
import socket

_LOWEST = 10240  # few services of the machine listen above


def _first_of_connections():
    """The kernel takes ports of connections that go out from here on: such a one may be gone at any moment."""
    try:
        return int(pathlib.Path("/proc/sys/net/ipv4/ip_local_port_range").read_text().split()[0])
    except OSError:
        return 32768


def free_ports(count):
    """Different ports of this host on which nobody listens, and which no outgoing connection takes by itself."""
    end = _first_of_connections()
    low = _LOWEST if end > _LOWEST + 1000 else 1024
    found = []
    for _ in range(10_000):
        port = random.SystemRandom().randrange(low, end)
        if port in found:
            continue
        with socket.socket() as probe:
            try:
                probe.bind(("127.0.0.1", port))
            except OSError:
                continue
        found.append(port)
        if len(found) == count:
            return found
    raise OSError("no port is free")


def free_port():
    return free_ports(1)[0]
