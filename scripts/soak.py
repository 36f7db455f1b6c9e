#!/usr/bin/env python3
"""Simulated camera, with frames rendered ahead of time, and localizer in one nodelet manager: measures for some minutes
how many frames are answered, how fast, and whether memory stays flat.

Arguments as ARGUMENT:=VALUE go to simulated_camera.launch. Exit status 1: a limit is not met; docs/reliability.md has
the limits. Limits of how many frames are answered, and how fast, are judged only where the machine was free meanwhile; 77:
it never was. The others (newest cloud only, flat memory, clean end) hold whatever else runs."""

import argparse
import collections
import contextlib
import enum
import math
import os
import signal
import socket
import struct
import subprocess
import sys
import tempfile
import threading
import time
import xmlrpc.client

import rosgraph
import rospy
from sensor_msgs.msg import CameraInfo

import free_machine
from grasp_affordances.msg import LocalizationStatistics

GRAPH = {'scene': 'table', 'motion': 'orbit', 'rate': '30', 'frames_ahead': '60'}
MANAGER = '/camera_nodelet_manager'

MEMORY_LIMIT = 1.0  # MB, change after the settling time
LARGEST_SHARE = 2 / 3  # of the camera's period that may go into a cloud where --adapt-rate keeps the rate
ADAPTING_TIME = 10     # s that it watches

Limits = collections.namedtuple('Limits', 'answered settling_time')  # share of the frames sent; s
LONG = 10.0  # minutes, from which on a run is a long one
LONG_RUN = Limits(0.999, 60)
SHORT_RUN = Limits(0.99, 20)  # in one minute, as many frames may be lost as in a long run

# Of roslaunch, where a node did not end as it should.
BAD_ENDS = ('has died', 'escalating to')


class Graph:
    """A ROS graph of its own, beside any other one on this machine."""

    def __init__(self, arguments):
        with socket.socket() as free:
            free.bind(('127.0.0.1', 0))
            port = free.getsockname()[1]
        self._folder = tempfile.TemporaryDirectory(prefix='grasp_affordances_soak_')
        self._output = open(os.path.join(self._folder.name, 'output'), 'w+')
        os.environ.update(ROS_IP='127.0.0.1', ROS_MASTER_URI='http://127.0.0.1:%d' % port,
                          ROS_LOG_DIR=self._folder.name)
        self._process = subprocess.Popen(
            ['roslaunch', '--port', str(port), 'grasp_affordances', 'simulated_camera.launch'] + arguments,
            stdout=self._output, stderr=subprocess.STDOUT)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self._process.send_signal(signal.SIGINT)
        self._process.wait()
        self._output.seek(0)
        self.output = self._output.read()
        self._output.close()
        self._folder.cleanup()

    def wait(self, condition, otherwise):
        """Until the condition holds; ends this program where the graph ends before, or after two minutes."""
        end = time.monotonic() + 120
        while not condition():
            if time.monotonic() > end or self._process.poll() is not None:
                self.fail(otherwise)
            time.sleep(0.1)

    def fail(self, message):
        self._output.seek(0)
        sys.exit(self._output.read() + message)


class StuckSubscriber:
    """Subscribes to the markers without a node, and never reads."""

    def __init__(self):
        uri = rosgraph.Master(rospy.get_name()).lookupNode(MANAGER)
        topic = '/localizer/markers'
        _, _, (_, host, port) = xmlrpc.client.ServerProxy(uri).requestTopic('/stuck', topic, [['TCPROS']])
        fields = [field.encode() for field in ('callerid=/stuck', 'topic=' + topic, 'type=*', 'md5sum=*')]
        header = b''.join(struct.pack('<I', len(field)) + field for field in fields)
        self._socket = socket.create_connection((host, port))
        self._socket.sendall(struct.pack('<I', len(header)) + header)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self._socket.close()


class Recorder:
    """Keeps what camera and localizer tell about every frame, from the first answer on, within its block."""

    def __init__(self):
        self._lock = threading.Lock()
        self._sent = {}      # sequence numbers by stamp
        self._answers = []   # statistics, and the time from the stamp until they arrived here, in ms
        self._subscribers = [
            rospy.Subscriber('camera/depth/camera_info', CameraInfo, self._frame, queue_size=100),
            rospy.Subscriber('localizer/statistics', LocalizationStatistics, self._answer, queue_size=100)]

    def __enter__(self):
        return self

    def __exit__(self, *_):
        for subscriber in self._subscribers:
            subscriber.unregister()

    def _frame(self, message):
        with self._lock:
            self._sent[message.header.stamp] = message.header.seq

    def _answer(self, message):
        age = (rospy.Time.now() - message.header.stamp).to_sec() * 1e3
        with self._lock:
            self._answers.append((message, age))

    def has_answers(self):
        with self._lock:
            return len(self._answers) > 0

    def results(self):
        """The answers, and how many frames were sent from the first one's to the last one's."""
        with self._lock:
            # The two connections are not made at the same moment.
            answers = [(message, age) for message, age in self._answers if message.header.stamp in self._sent]
            first, last = (answers[i][0].header.stamp for i in (0, -1))
            return answers, self._sent[last] - self._sent[first]


class Process:
    """What the system knows of a process."""

    def __init__(self, pid):
        self._folder = '/proc/%d/' % pid

    def memory(self):
        """Resident, in MB."""
        with open(self._folder + 'status') as file:
            return next(int(line.split()[1]) for line in file if line.startswith('VmRSS:')) / 1024

    def processor_time(self):
        """In seconds."""
        with open(self._folder + 'stat') as file:
            user, system = file.read().rpartition(')')[2].split()[11:13]
        return (int(user) + int(system)) / os.sysconf('SC_CLK_TCK')


def manager():
    uri = rosgraph.Master(rospy.get_name()).lookupNode(MANAGER)
    return Process(xmlrpc.client.ServerProxy(uri).getPid(rospy.get_name())[2])


def percentile(values, percent):
    """The smallest of the values that at least so many percent do not exceed."""
    return sorted(values)[math.ceil(len(values) * percent / 100) - 1]


def spread(values):
    return 'ms: median %.1f, 99th percentile %.1f, largest %.1f' % (percentile(values, 50), percentile(values, 99),
                                                                    max(values))


def watch(process, seconds):
    """Its memory at every second, and its processor time, in cores."""
    memory = []
    print_every = 60 if seconds <= 1200 else 300
    own, start = process.processor_time(), time.monotonic()
    for second in range(seconds):
        time.sleep(max(0.0, start + second + 1 - time.monotonic()))
        memory.append(process.memory())
        if (second + 1) % print_every == 0:
            print('%d min: %.1f MB' % ((second + 1) // 60, memory[-1]), flush=True)
    return memory, (process.processor_time() - own) / (time.monotonic() - start)


class Figures:
    """Prints figures, and remembers which kinds of limits are met."""

    def __init__(self):
        self.measured_met = True  # what depends on what else runs
        self.promised_met = True  # what does not

    def line(self, name, text):
        print('%-12s %s' % (name, text), flush=True)

    def measured_line(self, name, text, limit, met):
        self.measured_met = self.measured_met and met
        self._limited_line(name, text, limit, met)

    def promised_line(self, name, text, limit, met):
        self.promised_met = self.promised_met and met
        self._limited_line(name, text, limit, met)

    def _limited_line(self, name, text, limit, met):
        self.line(name, '%s; %s: %s' % (text, limit, 'met' if met else 'NOT MET'))


def is_of_the_promised_kind(options):
    """Whether 30 Hz are promised: for processors with AVX-512, and kernels that use it."""
    with open('/proc/cpuinfo') as file:
        return not options.plain_kernels and 'avx512f' in file.read().split()


def end_rospy():
    try:
        rospy.signal_shutdown('measured')
    except AttributeError:
        pass  # rospy 1.15.9 asks for Thread.isAlive, which Python 3.9 has no more, when all the rest is done


def localization_time(graph):
    """Median, in ms."""
    with Recorder() as recorder:
        graph.wait(recorder.has_answers, 'no frame was answered')
        time.sleep(ADAPTING_TIME)
        answers, _ = recorder.results()
    return percentile([message.milliseconds_total for message, _ in answers], 50)


class Verdict(enum.Enum):
    """Of so many minutes."""
    MET = enum.auto()
    MEASUREMENT_NOT_MET = enum.auto()
    NOT_JUDGED = enum.auto()
    PROMISE_BROKEN = enum.auto()


def measure(graph, period, minutes, stuck_subscriber):
    """Prints the figures of so many minutes. Their verdict, and the reason where they are not judged."""
    with Recorder() as recorder:
        graph.wait(recorder.has_answers, 'no frame was answered')
        try:
            with free_machine.Watch() as machine, StuckSubscriber() if stuck_subscriber else contextlib.nullcontext():
                memory, own = watch(manager(), round(60 * minutes))
        except FileNotFoundError:
            graph.fail('the nodelet manager ended')
        answers, sent = recorder.results()
    figures = report(LONG_RUN if minutes >= LONG else SHORT_RUN, period, answers, sent, memory)
    figures.line('processor', 'of %d cores: manager %.2f, other programs on this machine %.2f' %
                 (os.cpu_count(), own, machine.mean()))
    if not figures.promised_met:
        return Verdict.PROMISE_BROKEN, ''
    if figures.measured_met:
        return Verdict.MET, ''
    reason = machine.reason_not_free()
    if reason:
        print('not judged: ' + reason, flush=True)
    return (Verdict.NOT_JUDGED if reason else Verdict.MEASUREMENT_NOT_MET), reason


def newest_only(statistics):
    """Whether each cloud is newer than the one before it, and all but the newest one that waits are accounted for."""
    stamps = [message.header.stamp for message in statistics]
    waiting = {message.clouds_received - message.clouds_processed - message.clouds_dropped - message.clouds_rejected
               for message in statistics}
    return stamps == sorted(set(stamps)) and waiting <= {0, 1}


def report(limits, period, answers, sent, memory):
    statistics = [message for message, _ in answers]
    first, last = statistics[0], statistics[-1]
    answered = last.clouds_processed - first.clouds_processed
    latency = [message.milliseconds_latency for message in statistics]
    settled = memory[limits.settling_time - 1:]
    change = max(abs(value - settled[0]) for value in settled)

    figures = Figures()
    figures.line('frames', '%d sent in %.0f s' % (sent, (last.header.stamp - first.header.stamp).to_sec()))
    figures.measured_line('answered', '%d, %.3f %% (%d superseded, %d rejected)' %
                          (answered, 100 * answered / sent, last.clouds_dropped - first.clouds_dropped,
                           last.clouds_rejected - first.clouds_rejected),
                          'at least %g %%' % (100 * limits.answered), answered >= limits.answered * sent)
    figures.promised_line('order', '%d answers' % len(statistics), 'the newest cloud only', newest_only(statistics))
    figures.line('localization', spread([message.milliseconds_total for message in statistics]))
    figures.measured_line('latency', spread(latency), '99th percentile below %.0f' % period,
                          percentile(latency, 99) < period)
    figures.line('to listener', spread([age for _, age in answers]))
    figures.promised_line('memory', 'MB: %.2f after %d s, %.2f at the end, largest change %.2f' %
                          (settled[0], limits.settling_time, settled[-1], change),
                          'at most %g' % MEMORY_LIMIT, change <= MEMORY_LIMIT)
    return figures


def measure_repeatedly(graph, period, options):
    """Until one of the attempts meets all limits or breaks a promise. One that a free machine did not meet counts for more
    than those that are not judged."""
    verdict, reason = Verdict.NOT_JUDGED, ''
    for attempt in range(options.attempts):
        if attempt > 0:
            print('again:', flush=True)
        this, why = measure(graph, period, options.minutes, options.stuck_subscriber)
        if this in (Verdict.MET, Verdict.PROMISE_BROKEN):
            return this, ''
        if this == Verdict.MEASUREMENT_NOT_MET or attempt == 0:
            verdict, reason = this, why
    return verdict, reason


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('--minutes', type=float, default=LONG, help='to measure, at least 0.5 (default: %(default)g)')
    parser.add_argument('--stuck-subscriber', action='store_true', help='one more, of the markers, that never reads')
    parser.add_argument('--attempts', type=int, default=1, help='to meet the limits (default: %(default)d)')
    parser.add_argument('--adapt-rate', action='store_true',
                        help="on a processor without AVX-512 halve the camera's rate until a cloud takes two thirds of "
                             'its period or less')
    parser.add_argument('--plain-kernels', action='store_true',
                        help='the kernels are plain code, as without Highway: no processor counts as one with AVX-512')
    parser.add_argument('arguments', nargs='*', metavar='ARGUMENT:=VALUE', help='of simulated_camera.launch')
    options = parser.parse_args()
    if options.minutes < 0.5:
        parser.error('--minutes must be at least 0.5')
    if not all(':=' in argument for argument in options.arguments):
        parser.error('what is not an option must be ARGUMENT:=VALUE')

    arguments = dict(GRAPH, **dict(argument.split(':=', 1) for argument in options.arguments))
    rate = float(arguments['rate'])
    with Graph(['%s:=%s' % item for item in arguments.items()]) as graph:
        graph.wait(rosgraph.is_master_online, 'no ROS master')
        rospy.init_node('soak', disable_signals=True)
        adapts = options.adapt_rate and not is_of_the_promised_kind(options)
        median = localization_time(graph) if adapts else 0.0
        fast_enough = median <= LARGEST_SHARE * 1e3 / rate
        verdict, reason = measure_repeatedly(graph, 1e3 / rate, options) if fast_enough else (None, '')
        end_rospy()
    if any(sign in graph.output for sign in BAD_ENDS):
        sys.exit(graph.output + 'not all nodes ended as they should')
    if not fast_enough:
        print('%g Hz is too much for this machine: a cloud takes %.1f ms' % (rate, median), flush=True)
        # Another process, for rospy knows one master in its life.
        arguments = [word for word in sys.argv if not word.startswith('rate:=')] + ['rate:=%g' % (rate / 2)]
        os.execv(sys.executable, [sys.executable] + arguments)
    if verdict == Verdict.NOT_JUDGED:
        print('SKIPPED: ' + reason, flush=True)
        sys.exit(free_machine.SKIPPED)
    sys.exit(0 if verdict == Verdict.MET else 1)


if __name__ == '__main__':
    main()
