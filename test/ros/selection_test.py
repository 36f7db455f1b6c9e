#!/usr/bin/python3
"""An operator, or a program, selects a handle, which is then followed; the localizer is a plain node or a nodelet."""

import math
import subprocess
import unittest

import rospy
import rostest
from geometry_msgs.msg import PoseStamped
from rosgraph_msgs.msg import Log
from visualization_msgs.msg import InteractiveMarkerFeedback, InteractiveMarkerInit, InteractiveMarkerUpdate, Marker

from grasp_affordances.msg import Handle, HandleArray
from grasp_affordances.srv import BestHandle, SelectHandle
from helpers import Listener, executable, others_subscribed_to, publisher, scene, wait_until

INTERACTIVE = 'localizer/handles_interactive/'
MOST_IDS = 2 ** 32 - 1


def angle_between(p, q):
    """rad, between two orientations."""
    return 2 * math.acos(min(1.0, abs(p.x * q.x + p.y * q.y + p.z * q.z + p.w * q.w)))


def moved(a, b):
    """Whether two poses differ by more than noise."""
    return (angle_between(a.orientation, b.orientation) > 0.1 or
            abs(a.position.x - b.position.x) + abs(a.position.y - b.position.y) + abs(a.position.z - b.position.z) > 0.01)


class Selection(unittest.TestCase):
    def setUp(self):
        self.listeners = []
        self.handles = self.listen('localizer/handles', HandleArray)
        self.selected = self.listen('localizer/selected', Handle)
        self.pose = self.listen('localizer/selected_pose', PoseStamped)
        self.markers = self.listen(INTERACTIVE + 'update_full', InteractiveMarkerInit)
        self.feedback = rospy.Publisher(INTERACTIVE + 'feedback', InteractiveMarkerFeedback, queue_size=10)
        wait_until(lambda: self.feedback.get_num_connections() == 1, 'connection')
        self.select = rospy.ServiceProxy('localizer/select', SelectHandle)
        self.best = rospy.ServiceProxy('localizer/best', BestHandle)
        self.select.wait_for_service(20)
        self.best.wait_for_service(20)
        self.scene = None
        self.show('table')
        self.known = self.later(self.handles, lambda m: m.handles and self.drawn_like(m)).handles
        self.approachable = [handle for handle in self.known if handle.hand_poses]
        self.assertTrue(self.approachable, 'no handle can be approached')

    def tearDown(self):
        self.select(id=0)
        self.scene.interrupt()
        for listener in self.listeners:
            listener.close()

    def listen(self, topic, kind):
        self.listeners.append(Listener(topic, kind))
        return self.listeners[-1]

    def show(self, name):
        """Clouds of another scene from now on."""
        if self.scene:
            self.scene.interrupt()
        self.scene = publisher(scene(name), rate=5)

    def later(self, listener, accept=lambda message: True):
        """The first message that is accepted of those that come from now on."""
        before = len(listener.messages())
        wait_until(lambda: any(accept(m) for m in listener.messages()[before:]), 'a suitable message')
        return next(m for m in listener.messages()[before:] if accept(m))

    def shown(self):
        """Interactive markers by name, as in a viewer that has just connected."""
        messages = self.markers.messages()
        return {marker.name: marker for marker in messages[-1].markers} if messages else {}

    def drawn_like(self, message):
        return set(self.shown()) == {'handle_%d' % handle.id for handle in message.handles}

    def send(self, handle, event, entry=0):
        self.feedback.publish(InteractiveMarkerFeedback(
            client_id='operator', marker_name='handle_%d' % handle.id, control_name='body', event_type=event,
            menu_entry_id=entry))

    def click(self, handle):
        self.send(handle, InteractiveMarkerFeedback.BUTTON_CLICK)

    def choose(self, handle, title):
        """The entry of that title in the handle's menu, which may be still to come."""
        def entries():
            marker = self.shown().get('handle_%d' % handle.id)
            return [entry.id for entry in marker.menu_entries if entry.title == title] if marker else []
        wait_until(entries, 'menu entry ' + title)
        self.send(handle, InteractiveMarkerFeedback.MENU_SELECT, entries()[0])

    def wait_for(self, selected_id):
        """Until the newest selection is of that id."""
        wait_until(lambda: self.selected.messages() and self.selected.messages()[-1].id == selected_id,
                   'selection of %d' % selected_id)

    def colours(self, name):
        """Of the cylinders of a handle."""
        marker = self.shown().get(name)
        return {(m.color.r, m.color.g, m.color.b) for control in marker.controls for m in control.markers
                if m.type == Marker.CYLINDER} if marker else set()

    def test_a_click_selects_and_another_one_deselects(self):
        handle = self.approachable[-1]
        name = 'handle_%d' % handle.id
        before = self.colours(name)
        self.click(handle)
        self.wait_for(handle.id)
        wait_until(lambda: self.colours(name) and self.colours(name) != before, 'another colour')
        self.assertEqual([control.name for control in self.shown()[name].controls], ['body', 'hand'])
        selected = self.later(self.selected)
        pose = self.pose.wait(lambda m: m.header.stamp == selected.header.stamp)
        self.assertEqual(pose.header.frame_id, selected.header.frame_id)
        self.assertIn(pose.pose, [hand.pose for hand in selected.hand_poses])

        self.click(handle)
        self.wait_for(0)
        wait_until(lambda: self.colours(name) == before, 'the old colour')

    def test_a_click_at_another_one_selects_that(self):
        if len(self.known) < 2:
            self.skipTest('only one handle is known')
        for handle in self.known[:2]:
            self.click(handle)
            self.wait_for(handle.id)

    def test_the_menu_selects_and_deselects(self):
        handle = self.approachable[0]
        self.choose(handle, 'Select')
        self.wait_for(handle.id)
        self.choose(handle, 'Deselect')
        self.wait_for(0)

    def test_the_menu_goes_through_the_hand_poses(self):
        several = [handle for handle in self.approachable if len(handle.hand_poses) > 1]
        self.assertTrue(several, 'no handle has several hand poses')
        handle = several[0]
        self.click(handle)
        first = self.pose.wait()
        self.choose(handle, 'Next hand pose')
        second = self.later(self.pose, lambda m: moved(m.pose, first.pose))
        for _ in range(3):  # it stays the same one from cloud to cloud
            self.assertFalse(moved(self.later(self.pose).pose, second.pose))
        self.choose(handle, 'Previous hand pose')
        self.later(self.pose, lambda m: not moved(m.pose, first.pose))

    def test_a_program_selects_by_id(self):
        handle = self.approachable[0]
        answer = self.select(id=handle.id)
        self.assertTrue(answer.success, answer.message)
        self.assertEqual(answer.handle.id, handle.id)
        self.wait_for(handle.id)
        self.pose.wait()
        self.assertTrue(self.select(id=0).success)
        self.wait_for(0)

    def test_an_unknown_id_is_refused(self):
        handle = self.approachable[0]
        self.click(handle)
        self.wait_for(handle.id)
        answer = self.select(id=MOST_IDS)
        self.assertFalse(answer.success)
        for part in [MOST_IDS] + [handle.id for handle in self.known]:
            self.assertIn(str(part), answer.message)
        self.later(self.selected, lambda m: m.id == handle.id)  # as before

    def test_the_best_is_told_and_selected_only_when_asked_for(self):
        answer = self.best(select=False)
        self.assertTrue(answer.success, answer.message)
        self.assertEqual(answer.handle.score, max(h.score for h in self.handles.wait(
            lambda m: m.header.stamp == answer.handle.header.stamp).handles if h.hand_poses))
        self.assertEqual(answer.hand_pose.pose, answer.handle.hand_poses[0].pose)
        self.assertEqual(answer.hand_pose.header.frame_id, answer.handle.header.frame_id)
        self.later(self.handles)
        self.assertNotIn(answer.handle.id, [m.id for m in self.selected.messages()])

        self.assertTrue(self.best(select=True).success)
        self.wait_for(answer.handle.id)
        self.pose.wait()

    def test_the_selection_is_latched_and_followed(self):
        handle = self.approachable[0]
        self.select(id=handle.id)
        first = self.selected.wait(lambda m: m.id == handle.id)
        self.later(self.selected, lambda m: m.id == handle.id and m.header.stamp > first.header.stamp)
        self.later(self.pose, lambda m: m.header.stamp > first.header.stamp)
        self.scene.interrupt()
        late = Listener('localizer/selected', Handle), Listener('localizer/selected_pose', PoseStamped)
        self.assertEqual(late[0].wait().id, handle.id)
        self.assertGreater(late[1].wait().header.stamp, first.header.stamp)
        for listener in late:
            listener.close()

    def test_an_empty_table_loses_it(self):
        log = self.listen('/rosout', Log)
        handle = self.approachable[0]
        self.select(id=handle.id)
        self.wait_for(handle.id)
        self.show('empty_table')
        self.wait_for(0)
        wait_until(lambda: self.markers.messages()[-1].markers == [], 'removal of the markers')
        self.later(self.handles)
        self.later(self.handles)
        self.assertEqual(len([m for m in log.messages() if 'handle %d is lost' % handle.id in m.msg]), 1)
        for answer in (self.select(id=handle.id), self.best(select=True)):
            self.assertFalse(answer.success)
            self.assertIn('no handle is known', answer.message)

    def test_the_example_client_picks_the_best(self):
        answer = self.best(select=False)
        command = [executable('grasp_affordances', 'pick_best.py'), '--node', 'localizer', '--select']
        client = subprocess.run(command, stdout=subprocess.PIPE, timeout=30)
        self.assertEqual(client.returncode, 0)
        for part in ('handle %d' % answer.handle.id, answer.handle.header.frame_id):
            self.assertIn(part, client.stdout.decode())
        self.wait_for(answer.handle.id)

        nobody = subprocess.run(command + ['--node', 'nobody', '--timeout', '1'], stderr=subprocess.PIPE, timeout=30)
        self.assertEqual(nobody.returncode, 1)
        self.assertIn('nobody', nobody.stderr.decode())

    def test_handles_of_a_cloud_long_ago_are_no_answer(self):
        handle = self.approachable[0]
        self.assertTrue(self.best().success)
        self.scene.interrupt()
        wait_until(lambda: not self.best().success, 'refusal')
        for answer in (self.best(), self.select(id=handle.id)):
            self.assertFalse(answer.success)
            self.assertRegex(answer.message, r'^the last cloud that was localized in came [56]\.\d s ago, .* 5 s .*max_age')
        self.assertTrue(self.select(id=0).success)

        command = [executable('grasp_affordances', 'pick_best.py'), '--node', 'localizer', '--timeout', '1']
        client = subprocess.run(command, stderr=subprocess.PIPE, timeout=30)
        self.assertEqual(client.returncode, 1)
        # rospy 1.15.9 has more to say at its end.
        self.assertRegex(client.stderr.decode(), r'^pick_best\.py: .* came \d+\.\d s ago, .*\n')
        self.assertGreater(self.best().age, 5)

        self.show('table')
        wait_until(lambda: self.best().success, 'an answer from a new cloud')
        self.assertLess(self.best().age, 5)

    def test_who_listens_to_selection_or_interactive_markers_is_a_listener(self):
        while self.listeners:
            self.listeners.pop().close()
        wait_until(lambda: not others_subscribed_to('/points'), 'end of the subscription')
        for topic, kind in (('localizer/selected', Handle), ('localizer/selected_pose', PoseStamped),
                            (INTERACTIVE + 'update', InteractiveMarkerUpdate)):
            listener = Listener(topic, kind)
            wait_until(lambda: others_subscribed_to('/points'), topic)
            listener.close()
            wait_until(lambda: not others_subscribed_to('/points'), 'end of ' + topic)


if __name__ == '__main__':
    rospy.init_node('selection_test')
    rostest.rosrun('grasp_affordances', 'selection', Selection)
