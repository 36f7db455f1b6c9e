"""Peers that speak ROS's protocols themselves: they need no master, and may do what no client library does."""

import socket
import struct
import urllib.parse
import xmlrpc.client

from helpers import TIME_FACTOR

TIMEOUT = 20 * TIME_FACTOR  # s


def _header(**fields):
    lines = [('%s=%s' % item).encode() for item in fields.items()]
    text = b''.join(struct.pack('<I', len(line)) + line for line in lines)
    return struct.pack('<I', len(text)) + text


class _Peer:
    """A connection on which blocks of bytes go, each after its length."""

    def __init__(self, host, port, receive_buffer=None):
        self._socket = socket.socket()
        if receive_buffer:
            self._socket.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, receive_buffer)
        self._socket.settimeout(TIMEOUT)
        self._socket.connect((host, int(port)))

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def close(self):
        self._socket.close()

    def reset(self):
        """Ends the connection as a process that is killed does, with what was not read or sent lost."""
        self._socket.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, struct.pack('ii', 1, 0))
        self.close()

    def send(self, data):
        self._socket.sendall(data)

    def receive(self, size):
        data = bytearray()
        while len(data) < size:
            part = self._socket.recv(min(size - len(data), 1 << 20))
            if not part:
                raise ConnectionError('closed by the node')
            data += part
        return bytes(data)

    def receive_block(self):
        return self.receive(struct.unpack('<I', self.receive(4))[0])


class RawSubscriber(_Peer):
    """Subscribes to a topic of the node with that URI and reads nothing until it is told to."""

    def __init__(self, node_uri, topic, receive_buffer=None):
        code, status, protocol = xmlrpc.client.ServerProxy(node_uri).requestTopic('/raw_peer', topic, [['TCPROS']])
        if code != 1:
            raise ConnectionError(status)
        super().__init__(*protocol[1:], receive_buffer)
        self.send(_header(callerid='/raw_peer', topic=topic, type='*', md5sum='*'))
        self._started = False

    def message(self, message_type):
        """The next one."""
        if not self._started:
            self.receive_block()  # what the node tells of itself
            self._started = True
        return message_type().deserialize(self.receive_block())


class RawCaller(_Peer):
    """A connection to a service, of which lookupService() gives the address."""

    def __init__(self, address, service):
        url = urllib.parse.urlparse(address)
        super().__init__(url.hostname, url.port)
        self.send(_header(callerid='/raw_peer', service=service, md5sum='*'))

    def ask(self, request):
        """Sends a serialized request, or a part of one."""
        self.send(struct.pack('<I', len(request)) + request)


def connections_to(address):
    """How many connections the node with a service of that address has not closed at its end."""
    closed = ('06', '0A')  # those that only linger, and the socket that listens
    with open('/proc/net/tcp') as file:
        lines = [line.split() for line in file][1:]
    return sum(int(line[1].split(':')[1], 16) == urllib.parse.urlparse(address).port and line[3] not in closed
               for line in lines)
