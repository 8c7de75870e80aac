"""Clients whose requests stay open as long as a test wants: bodies that do not end, answers that are not read. Over HTTP/1.1
each request has a connection, over HTTP/2 all requests of a client share one."""
import dataclasses
import select
import socket
import ssl
import struct

from service import wait_until


@dataclasses.dataclass
class Exchange:
    number: int
    is_being_read: bool = False  # the server asks for the body
    status: int = 0  # 0: there is no answer yet
    body: bytes = b""
    has_ended: bool = False
    fields: dict = dataclasses.field(default_factory=dict)  # of HTTP/1.1, names in small letters

    def is_decided(self):
        return self.is_being_read or self.status != 0


class Client:
    """Common to both. A front is that of bench/hostile.py, the address one of this machine."""

    def __init__(self, front, address="127.0.0.1"):
        self.front = front
        self.address = address
        self.exchanges = []

    def connect(self, context):
        client = socket.create_connection(("127.0.0.1", self.front.port), 60, source_address=(self.address, 0))
        return context.wrap_socket(client, server_hostname="localhost")

    def wait_for(self, condition, what="answers"):
        def is_true():
            self.read()
            return condition()

        wait_until(is_true, what=what)

    def decided(self, exchange):
        """The same exchange, once the server has answered it or asks for its body."""
        self.wait_for(exchange.is_decided, "a decision")
        return exchange

    def ended(self, exchange):
        """The same exchange, with its whole answer."""
        self.wait_for(lambda: exchange.has_ended, "the end of an answer")
        return exchange

    def statuses(self):
        """Of all answers that have begun so far."""
        return [exchange.status for exchange in self.exchanges if exchange.status]


class Http1(Client):
    def __init__(self, front, address="127.0.0.1"):
        super().__init__(front, address)
        self.sockets = {}
        self.answered = []  # they are kept open: nginx listens for a while to who was refused

    def begin(self, method, path, headers=None, length=None, is_chunked=False):
        """Sends a request's head. Of a body with a length or in chunks nothing follows."""
        fields = {"Host": f"localhost:{self.front.port}", **(headers or {})}
        if length is not None:
            fields |= {"Content-Length": length, "Expect": "100-continue"}
        if is_chunked:
            fields |= {"Transfer-Encoding": "chunked", "Expect": "100-continue"}
        client = self.connect(self.front.context)
        head = "".join(f"{name}: {value}\r\n" for name, value in fields.items())
        client.sendall(f"{method} {path} HTTP/1.1\r\n{head}\r\n".encode())
        client.setblocking(False)
        exchange = Exchange(len(self.exchanges))
        self.exchanges.append(exchange)
        self.sockets[client] = (exchange, bytearray())
        return exchange

    def send(self, exchange, data):
        client = next(client for client, (of_client, _) in self.sockets.items() if of_client is exchange)
        client.setblocking(True)
        client.sendall(data)
        client.setblocking(False)

    def read(self):
        """Reads what has come."""
        for client in select.select(list(self.sockets), [], [], 0)[0]:
            exchange, received = self.sockets[client]
            try:
                while part := client.recv(1 << 16):
                    received += part
                exchange.has_ended = True
            except ssl.SSLWantReadError:
                pass
            except OSError:
                exchange.has_ended = True
            self.take(exchange, received)
            if exchange.has_ended:
                del self.sockets[client]
                self.answered.append(client)

    def take(self, exchange, received):
        go_on = b"HTTP/1.1 100 Continue\r\n\r\n"
        if received.startswith(go_on):
            exchange.is_being_read = True
            del received[: len(go_on)]
        head, end, body = bytes(received).partition(b"\r\n\r\n")
        if not end:
            return
        first, *lines = head.decode().split("\r\n")
        exchange.status = int(first.split()[1])
        for line in lines:
            name, _, value = line.partition(":")
            exchange.fields[name.lower()] = value.strip()
        exchange.body = body
        if len(body) >= int(exchange.fields.get("content-length", len(body) + 1)):
            exchange.has_ended = True

    def close(self):
        for client in (*self.sockets, *self.answered):
            client.close()
        self.sockets.clear()


class Http2(Client):
    """RFC 9113 as far as nginx needs it: fields are sent as they are, of those received only the status is read, which
    nginx writes first and never compresses."""

    DATA, HEADERS, RESET, SETTINGS, PING, GO_AWAY, WINDOW = 0, 1, 3, 4, 6, 7, 8
    ENDS_STREAM, ACKNOWLEDGES, ENDS_HEADERS = 1, 1, 4
    INITIAL_WINDOW = 4
    # RFC 7541, appendix A.
    INDEXED_STATUSES = {8: 200, 9: 204, 10: 206, 11: 304, 12: 400, 13: 404, 14: 500}

    def __init__(self, front, address="127.0.0.1", window=65535):
        super().__init__(front, address)
        context = ssl.create_default_context(cadata=ssl.DER_cert_to_PEM_cert(front.context.get_ca_certs(True)[0]))
        context.set_alpn_protocols(["h2"])
        self.client = self.connect(context)
        self.received = bytearray()
        self.client.sendall(b"PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n")
        self.frame(self.SETTINGS, 0, 0, struct.pack(">HI", self.INITIAL_WINDOW, window))
        self.client.setblocking(False)

    def frame(self, kind, flags, stream, payload=b""):
        self.client.setblocking(True)
        self.client.sendall(struct.pack(">I", len(payload))[1:] + struct.pack(">BBI", kind, flags, stream) + payload)
        self.client.setblocking(False)

    def begin(self, method, path, headers=None, length=None, is_chunked=False):
        """Sends a request's head. Of a body with a length or (is_chunked) without one nothing follows."""
        fields = {":method": method, ":scheme": "https", ":path": path, ":authority": f"localhost:{self.front.port}"}
        fields |= {name.lower(): str(value) for name, value in (headers or {}).items()}
        if length is not None:
            fields["content-length"] = str(length)
        block = b"".join(b"\0" + self.text(name) + self.text(value) for name, value in fields.items())
        exchange = Exchange(2 * len(self.exchanges) + 1)
        self.exchanges.append(exchange)
        flags = self.ENDS_HEADERS | (0 if is_chunked or length else self.ENDS_STREAM)
        self.frame(self.HEADERS, flags, exchange.number, block)
        return exchange

    @staticmethod
    def text(value):
        data = value.encode()
        if len(data) < 127:
            return bytes([len(data)]) + data
        rest, length = len(data) - 127, b"\x7f"
        while rest >= 128:
            length += bytes([rest % 128 + 128])
            rest //= 128
        return length + bytes([rest]) + data

    def reset(self, exchange):
        self.frame(self.RESET, 0, exchange.number, struct.pack(">I", 8))

    def read(self):
        """Reads what has come."""
        try:
            while part := self.client.recv(1 << 16):
                self.received += part
            raise ConnectionResetError("nginx has closed the connection")
        except ssl.SSLWantReadError:
            pass
        while len(self.received) >= 9:
            length = int.from_bytes(self.received[:3], "big")
            if len(self.received) < 9 + length:
                break
            kind, flags, stream = struct.unpack(">BBI", self.received[3:9])
            payload = bytes(self.received[9 : 9 + length])
            del self.received[: 9 + length]
            self.take(kind, flags, stream, payload)

    def take(self, kind, flags, stream, payload):
        if kind in (self.SETTINGS, self.PING) and not flags & self.ACKNOWLEDGES:
            self.frame(kind, self.ACKNOWLEDGES, 0, payload if kind == self.PING else b"")
        if kind == self.GO_AWAY:
            raise ConnectionResetError(f"nginx ends the connection: {payload!r}")
        if stream == 0:
            return
        exchange = self.exchanges[stream // 2]
        if kind == self.WINDOW:
            exchange.is_being_read = True
        elif kind == self.HEADERS:
            exchange.status = self.status_in(payload)
        elif kind == self.DATA:
            exchange.body += payload
        if kind == self.RESET or (kind in (self.HEADERS, self.DATA) and flags & self.ENDS_STREAM):
            exchange.has_ended = True

    def status_in(self, block):
        while block[0] & 0xE0 == 0x20:  # a new size of the table
            block = block[1:]
        if block[0] & 0x80:
            return self.INDEXED_STATUSES[block[0] & 0x7F]
        return int(block[2 : 2 + block[1]])

    def close(self):
        self.client.close()
