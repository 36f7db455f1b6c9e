"""What the rostests share: processes, simulated scenes, clouds made by hand, what arrives on topics, and measurements that
need a free machine."""

import atexit
import collections
import contextlib
import functools
import io
import os
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import threading
import time

import rosgraph
import roslib.packages
import rospy
from nodelet.srv import NodeletLoad, NodeletUnload
from sensor_msgs.msg import PointCloud2, PointField

sys.path.append(os.path.join(os.path.dirname(os.path.realpath(__file__)), '..', '..', 'scripts'))
import free_machine  # noqa: E402

# Of these speaks the output of a process that did not end well, whatever its exit code.
ABNORMAL_ENDS = ('boost', 'mutex', 'terminate', 'Assertion', 'rror:')

# What every time-out is multiplied by, as under a sanitizer.
TIME_FACTOR = int(os.environ.get('GRASP_AFFORDANCES_TIME_FACTOR', 1))

# AddressSanitizer keeps what was freed for a while: there the size of a process says nothing of what it uses.
FREED_MEMORY_IS_KEPT = 'ASAN_OPTIONS' in os.environ

# How often a byte that is used counts in the size of a process: ThreadSanitizer has four bytes of its own for each.
MEMORY_FACTOR = 5 if 'TSAN_OPTIONS' in os.environ else 1

ATTEMPTS = 3  # of a test that measures times

_scenes = None


def executable(package, name):
    return roslib.packages.find_node(package, name)[0]


def write_scene(name, file, seed=1, turn=0, noise_seed=0):
    """Writes a PCD file with what a camera sees of a simulated scene; `turn`: of the camera, in degrees."""
    subprocess.run([executable('grasp_affordances', 'write_scene'), name, str(seed), str(turn), str(noise_seed), file],
                   check=True, timeout=60 * TIME_FACTOR)


def scene(name):
    """Path of a PCD file with a simulated scene, seed 1."""
    global _scenes
    if _scenes is None:
        _scenes = tempfile.mkdtemp(prefix='grasp_affordances_scenes_')
        atexit.register(shutil.rmtree, _scenes)
    path = os.path.join(_scenes, name + '.pcd')
    if not os.path.exists(path):
        write_scene(name, path)
    return path


def recordings():
    """Folder of the recorded clouds, or None where they are absent."""
    folder = os.environ.get('GRASP_AFFORDANCES_DATA')
    if folder is not None:
        if not os.path.isdir(folder):
            raise AssertionError('GRASP_AFFORDANCES_DATA names no folder: ' + folder)
        return folder
    folder = os.path.join(os.path.dirname(os.path.realpath(__file__)), '..', '..', '..', 'shared', 'data')
    return folder if os.path.isdir(folder) else None


def skip(test, reason):
    """Ends a test that says nothing, and tells ctest so."""
    text = 'SKIPPED: %s: %s\n' % (test.id(), reason)
    if 'GRASP_AFFORDANCES_SKIPPED' in os.environ:
        with open(os.environ['GRASP_AFFORDANCES_SKIPPED'], 'a') as file:
            file.write(text)
    print(text, end='')
    test.skipTest(reason)


class NotJudged(Exception):
    """A measurement on a machine that was not free."""


class Measurement:
    """What a test measures; `machine`: a watch that has run since the test began."""

    def __init__(self, machine):
        self._machine = machine

    @contextlib.contextmanager
    def judged(self):
        """In this block stand the assertions that hold on a free machine only."""
        try:
            yield
        except AssertionError as error:
            reason = self._machine.reason_not_free()
            if not reason:
                raise
            raise NotJudged('%s; %s' % (reason, error)) from error


def measured(method):
    """A test method that has a Measurement as argument. Where that is not judged the test is run again, and at last
    skipped. Assertions outside of judged() hold whatever else runs."""
    @functools.wraps(method)
    def run(test):
        for attempt in range(ATTEMPTS):
            if attempt > 0:
                test.tearDown()
                test.doCleanups()
                test.setUp()
            try:
                with free_machine.Watch() as machine:
                    method(test, Measurement(machine))
                return
            except NotJudged as error:
                reason = str(error)
                rospy.logwarn('attempt %d is not judged: %s', attempt + 1, reason)
        skip(test, reason)
    return run


class Process:
    """A node in a process of its own. Its output is kept; leaving the block interrupts it and waits for its end."""

    def __init__(self, package, name, *arguments, environment=None):
        self._start([executable(package, name), *arguments], environment)

    def _start(self, command, environment=None):
        self._output = tempfile.TemporaryFile('a+b')  # the process writes at its end, wherever we read
        self._process = subprocess.Popen(command, stdout=self._output, stderr=subprocess.STDOUT, env=environment)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.interrupt()

    @property
    def pid(self):
        return self._process.pid

    def signal(self, number):
        self._process.send_signal(number)

    def interrupt(self):
        """Ends the process as Ctrl-C does; returns its exit code."""
        if self._process.poll() is None:
            self.signal(signal.SIGINT)
        return self.wait(15)

    def wait(self, timeout):
        try:
            return self._process.wait(timeout * TIME_FACTOR)
        except subprocess.TimeoutExpired:
            self._process.kill()
            self._process.wait()
            raise

    def output(self):
        self._output.seek(0)
        return self._output.read().decode()


class Program(Process):
    """Any program in a process of its own, found as a shell finds it."""

    def __init__(self, *command, environment=None):
        self._start(list(command), environment)


class Launch(Process):
    """One of our launch files."""

    def __init__(self, file, *arguments, environment=None):
        self._start(['roslaunch', 'grasp_affordances', file, *arguments], environment)


def manager(environment=None):
    """A nodelet manager of that name."""
    return Process('nodelet', 'nodelet', 'manager', '__name:=manager', environment=environment)


class Nodelets:
    """Loads nodelets of ours into the manager of manager() and unloads them, without a process that stands for each."""

    def __init__(self):
        self._load, self._unload = (rospy.ServiceProxy('manager/' + name, kind) for name, kind in
                                    (('load_nodelet', NodeletLoad), ('unload_nodelet', NodeletUnload)))
        for call in (self._load, self._unload):
            call.wait_for_service(20)

    def load(self, name, kind, remappings=()):
        """`remappings`: pairs of names."""
        sources, targets = zip(*remappings) if remappings else ((), ())
        self._load(name=name, type='grasp_affordances/' + kind, remap_source_args=sources, remap_target_args=targets)

    def unload(self, name):
        self._unload(name=name)


Usage = collections.namedtuple('Usage', 'memory threads files')  # MB, resident; numbers of threads and open files


def usage(process):
    """What a process takes of the machine."""
    with open('/proc/%d/status' % process.pid) as file:
        status = dict(line.split(':', 1) for line in file)
    return Usage(int(status['VmRSS'].split()[0]) / 1024, int(status['Threads']),
                 len(os.listdir('/proc/%d/fd' % process.pid)))


def processor_time(process):
    """Of all its threads, in seconds."""
    with open('/proc/%d/stat' % process.pid) as file:
        user, system = file.read().rpartition(')')[2].split()[11:13]
    return (int(user) + int(system)) / os.sysconf('SC_CLK_TCK')


def publisher(file, rate=0, frame='camera_depth_optical_frame', topic='points'):
    """pcd_publisher; rate in Hz, 0: once to each subscriber."""
    return Process('grasp_affordances', 'pcd_publisher', '_file:=' + file, '_rate:=%g' % rate, '_frame_id:=' + frame,
                   'points:=' + topic)


class Listener:
    """Keeps what arrives on a topic."""

    def __init__(self, topic, message_type):
        self._messages = []
        self._arrival = threading.Condition()
        self._subscriber = rospy.Subscriber(topic, message_type, self._receive, queue_size=100)

    def _receive(self, message):
        with self._arrival:
            self._messages.append((message, rospy.Time.now()))
            self._arrival.notify_all()

    def close(self):
        self._subscriber.unregister()

    def messages(self):
        with self._arrival:
            return [message for message, _ in self._messages]

    def arrivals(self):
        """Messages with the times of their arrival."""
        with self._arrival:
            return list(self._messages)

    def wait(self, accept=lambda message: True, timeout=20):
        """The first message that is accepted, of those that have arrived or come before the timeout."""
        timeout *= TIME_FACTOR
        end = time.monotonic() + timeout
        with self._arrival:
            while True:
                for message, _ in self._messages:
                    if accept(message):
                        return message
                left = end - time.monotonic()
                if left <= 0:
                    raise AssertionError('nothing suitable arrived on %s in %g s' % (self._subscriber.name, timeout))
                self._arrival.wait(left)


def published(name):
    """The cloud of a simulated scene, as it arrives on the topic points."""
    with publisher(scene(name)):
        listener = Listener('points', PointCloud2)
        message = listener.wait()
        listener.close()
    return message


def wait_until(condition, what, timeout=20):
    timeout *= TIME_FACTOR
    end = time.monotonic() + timeout
    while not condition():
        if time.monotonic() > end:
            raise AssertionError('%s: not within %g s' % (what, timeout))
        time.sleep(0.05)


def others_subscribed_to(topic):
    _, subscriptions, _ = rosgraph.Master(rospy.get_name()).getSystemState()
    return {node for name, nodes in subscriptions if name == topic for node in nodes} - {rospy.get_name()}


def cloud(width=8, height=6, frame='by_hand'):
    """A well-formed organized cloud of which nothing was measured."""
    message = PointCloud2(width=width, height=height, point_step=12, row_step=12 * width, is_bigendian=False)
    message.header.frame_id = frame
    message.header.stamp = rospy.Time.now()
    message.fields = [PointField(name=name, offset=4 * i, datatype=PointField.FLOAT32, count=1)
                      for i, name in enumerate('xyz')]
    message.data = struct.pack('<f', float('nan')) * (3 * width * height)
    return message


def moved_points(source, place, frame):
    """The measured points of a cloud as one without rows in another frame; place(point) is where a point is there."""
    points = [place(point) for point in coordinates(source) if point[2] == point[2]]
    message = cloud(width=len(points), height=1, frame=frame)
    message.data = b''.join(struct.pack('<fff', *point) for point in points)
    return message


def serialized(message):
    """Its bytes: unlike the message they are equal to others where both hold NaN."""
    buffer = io.BytesIO()
    message.serialize(buffer)
    return buffer.getvalue()


def coordinates(cloud):
    """(x, y, z) of every point, row-major."""
    offsets = {field.name: field.offset for field in cloud.fields}
    assert (offsets['x'], offsets['y'], offsets['z']) == (0, 4, 8)
    return list(struct.iter_unpack('<fff%dx' % (cloud.point_step - 12), cloud.data))


def rotated(q, v):
    """Vector v turned by the quaternion q."""
    tx, ty, tz = (2 * (q.y * v[2] - q.z * v[1]), 2 * (q.z * v[0] - q.x * v[2]), 2 * (q.x * v[1] - q.y * v[0]))
    return (v[0] + q.w * tx + q.y * tz - q.z * ty, v[1] + q.w * ty + q.z * tx - q.x * tz,
            v[2] + q.w * tz + q.x * ty - q.y * tx)
