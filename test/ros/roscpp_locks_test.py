#!/usr/bin/python3
"""Starts and ends in whose course roscpp 1.15.9 waits for itself, or nodelet 1.10 drops what arrives, unless our
nodelets call them in another order.

~repetitions: of the end of a manager.
"""

import http.client
import http.server
import os
import signal
import threading
import time
import unittest
import urllib.parse
import xmlrpc.client

import rosgraph
import rospy
import rostest

from grasp_affordances.msg import LocalizationStatistics

from helpers import Listener, Nodelets, Process, manager, publisher, scene, wait_until


class BadMaster(http.server.ThreadingHTTPServer):
    """Hands calls on to the master. The first ones that set parameters may be dropped unanswered: roscpp asks twice
    before it says so. The registration of one service may take long."""

    daemon_threads = True

    def __init__(self, drops=0, slow_service=None, seconds=0.0):
        super().__init__(('127.0.0.1', 0), Call)
        self.drops = drops
        self.slow_service = slow_service
        self.seconds = seconds
        self.is_slow = threading.Event()
        self._thread = threading.Thread(target=self.serve_forever, daemon=True)
        self._thread.start()

    def environment(self):
        return dict(os.environ, ROS_MASTER_URI='http://127.0.0.1:%d' % self.server_address[1])

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.shutdown()
        self._thread.join()
        self.server_close()


class Call(http.server.BaseHTTPRequestHandler):
    protocol_version = 'HTTP/1.1'

    def do_POST(self):
        body = self.rfile.read(int(self.headers['Content-Length']))
        arguments, method = xmlrpc.client.loads(body)
        if method == 'setParam' and self.server.drops > 0:
            self.server.drops -= 1
            self.close_connection = True
            return
        if method == 'registerService' and arguments[1] == self.server.slow_service:
            self.server.is_slow.set()
            time.sleep(self.server.seconds)
        master = urllib.parse.urlparse(rosgraph.get_master_uri())
        connection = http.client.HTTPConnection(master.hostname, master.port, timeout=10)
        connection.request('POST', '/RPC2', body, {'Content-Type': 'text/xml'})
        answer = connection.getresponse().read()
        connection.close()
        self.send_response(200)
        self.send_header('Content-Type', 'text/xml')
        self.send_header('Content-Length', str(len(answer)))
        self.end_headers()
        self.wfile.write(answer)

    def log_message(self, *_):
        pass


def services():
    return {name for name, _ in rosgraph.Master(rospy.get_name()).getSystemState()[2]}


class RoscppLocks(unittest.TestCase):
    def test_a_node_starts_although_the_master_drops_what_it_sets(self):
        """roscpp logs that it could not reach the master."""
        with BadMaster(drops=5) as master:
            with Process('grasp_affordances', 'localizer_node', environment=master.environment()) as node:
                wait_until(lambda: '/localizer/best' in services(), 'services')
                self.assertEqual(master.drops, 0)
                self.assertEqual(rospy.get_param('localizer/reconfigure/sampling_samples'), 2000)
                self.assertEqual(node.interrupt(), 0)

    def test_a_listener_that_connects_while_a_nodelet_starts_is_answered(self):
        """nodelet 1.10 drops the callback that tells of it until the nodelet has started."""
        with BadMaster(slow_service='/localizer/localize', seconds=2.0) as master, publisher(scene('table'), rate=10), \
                manager(master.environment()):
            loading = threading.Thread(target=Nodelets().load, args=('/localizer', 'LocalizerNodelet'), daemon=True)
            loading.start()
            self.assertTrue(master.is_slow.wait(20))
            listener = Listener('localizer/statistics', LocalizationStatistics)
            self.assertGreater(listener.wait().sampled, 0)
            listener.close()
            loading.join()

    def test_a_manager_ends_that_is_interrupted_while_it_unloads(self):
        """Its shutdown waits for the unloading, which must not wait for the shutdown."""
        interrupted = 0  # before the unloading had an end
        for repetition in range(rospy.get_param('~repetitions')):
            with manager() as host:
                nodelets = Nodelets()
                nodelets.load('/localizer', 'LocalizerNodelet')

                def unload():
                    try:
                        nodelets.unload('/localizer')
                    except (rospy.ServiceException, rospy.exceptions.ROSException):
                        pass  # the manager has ended before it answered

                unloading = threading.Thread(target=unload, daemon=True)
                unloading.start()
                time.sleep(0.012 * (repetition % 10))
                interrupted += unloading.is_alive()
                host.signal(signal.SIGINT)  # noticed within 0.1 s
                self.assertIn(host.wait(20), (0, -signal.SIGINT), host.output())
                unloading.join(20)
                self.assertFalse(unloading.is_alive())
            wait_until(lambda: not any(name.startswith('/manager/') for name in services()), 'end')
        self.assertGreater(interrupted, 0)


if __name__ == '__main__':
    rospy.init_node('roscpp_locks_test')
    rostest.rosrun('grasp_affordances', 'roscpp_locks', RoscppLocks)
