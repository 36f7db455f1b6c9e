#!/usr/bin/python3
"""The real rviz, with the package's configuration, shows handles where they are, and none after an empty table.

It runs on a virtual display and renders in software. Where a handle is in its picture follows from the view that the
configuration sets. The picture is left in the file that the environment variable RVIZ_TEST_PICTURE names.
"""

import os
import subprocess
import tempfile
import unittest

import numpy
import roslib.packages
import rospy
import rostest
import yaml

from grasp_affordances.msg import HandleArray
from helpers import Listener, Process, publisher, scene, wait_until

TIMEOUT = 60  # s, for what takes two on an idle machine
FIELD_OF_VIEW = numpy.pi / 4  # rad, vertical, of a view in rviz

CONFIGURATION = os.path.join(roslib.packages.get_pkg_dir('grasp_affordances'), 'config', 'localizer.rviz')
with open(CONFIGURATION) as file:
    SETTINGS = yaml.safe_load(file)
# On a screen of its own size without a window manager, the window is the screen.
WIDTH, HEIGHT = (SETTINGS['Window Geometry'][side] for side in ('Width', 'Height'))


class Display:
    """A virtual X display without a window manager."""

    def __init__(self):
        read, write = os.pipe()
        self._server = subprocess.Popen(
            ['Xvfb', '-displayfd', str(write), '-screen', '0', '%dx%dx24' % (WIDTH, HEIGHT), '-nolisten', 'tcp'],
            pass_fds=[write], stderr=subprocess.DEVNULL)
        os.close(write)
        with os.fdopen(read) as number:
            self.name = ':' + number.readline().strip()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self._server.terminate()
        self._server.wait(15)

    def picture(self):
        """What is shown: an array of height x width x RGB."""
        raw = subprocess.run(['import', '-display', self.name, '-window', 'root', '-depth', '8', 'rgb:-'], check=True,
                             stdout=subprocess.PIPE, timeout=30).stdout
        return numpy.frombuffer(raw, numpy.uint8).reshape(HEIGHT, WIDTH, 3).astype(float)

    def save(self, path):
        subprocess.run(['import', '-display', self.name, '-window', 'root', path], check=True, timeout=30)


def rviz(display):
    """rviz with nothing but the view, rendered in software."""
    environment = {**os.environ, 'DISPLAY': display.name, 'LIBGL_ALWAYS_SOFTWARE': '1', 'QT_QPA_PLATFORM': 'xcb',
                   'XDG_RUNTIME_DIR': tempfile.gettempdir()}
    return Process('rviz', 'rviz', '--display-config', CONFIGURATION, '--fullscreen', '--splash-screen', '',
                   environment=environment)


class View:
    """The orbiting view of a configuration: where points of its fixed frame are in the picture."""

    def __init__(self):
        view = SETTINGS['Visualization Manager']['Views']['Current']
        focus = numpy.array([view['Focal Point'][coordinate] for coordinate in 'XYZ'])
        yaw, pitch = view['Yaw'], view['Pitch']
        backward = numpy.array([numpy.cos(yaw) * numpy.cos(pitch), numpy.sin(yaw) * numpy.cos(pitch), numpy.sin(pitch)])
        right = numpy.cross([0, 0, 1], backward)
        right /= numpy.linalg.norm(right)
        self._position = focus + view['Distance'] * backward
        self._axes = numpy.array([right, -numpy.cross(backward, right), -backward])  # right, down, forward
        self._focal_length = HEIGHT / 2 / numpy.tan(FIELD_OF_VIEW / 2)

    def project(self, point):
        """Pixel coordinates, and pixels per metre there."""
        x, y, z = self._axes @ (numpy.array(point) - self._position)
        scale = self._focal_length / z
        return numpy.array([WIDTH / 2 + scale * x, HEIGHT / 2 + scale * y]), scale

    def near(self, points, distance):
        """Mask of the pixels within that distance, in metres, of points in space."""
        mask = numpy.zeros((HEIGHT, WIDTH), bool)
        for point in points:
            (x, y), scale = self.project(point)
            radius = scale * distance
            left, top = (max(int(center - radius), 0) for center in (x, y))
            window = mask[top:max(int(y + radius) + 1, 0), left:max(int(x + radius) + 1, 0)]
            rows, columns = numpy.ogrid[:window.shape[0], :window.shape[1]]
            window |= (left + columns + 0.5 - x) ** 2 + (top + rows + 0.5 - y) ** 2 < radius ** 2
        return mask


def axis_points(handle, step=0.002):
    """Points along a handle's axis."""
    corners = [numpy.array([p.x, p.y, p.z]) for p in handle.polyline]
    points = []
    for begin, end in zip(corners, corners[1:]):
        count = int(numpy.linalg.norm(end - begin) / step) + 2
        points += [begin + (end - begin) * share for share in numpy.linspace(0, 1, count)]
    return points


def colored(picture):
    """Mask of the pixels that have a color of scores, red over yellow to green, however brightly lit. Clouds are grey,
    shells and hands bluish."""
    red, green, blue = (picture[..., channel] for channel in range(3))
    return numpy.maximum(red, green) > 1.5 * blue + 30


def bluish(picture):
    """Mask of the pixels that show hand poses; those drawn before a handle hide a part of it."""
    red, _, blue = (picture[..., channel] for channel in range(3))
    return blue > 1.5 * red + 20


class Rviz(unittest.TestCase):
    def setUp(self):
        self.handles = Listener('localizer/handles', HandleArray)

    def tearDown(self):
        self.handles.close()

    def test_handles_are_where_they_project_to_and_gone_after_an_empty_table(self):
        with Display() as display, rviz(display):
            with publisher(scene('table'), rate=3):
                self.wait_for_picture(display, self.missing_handles)
            with publisher(scene('empty_table'), rate=3):
                self.wait_for_picture(display, self.stale_handles)

    def wait_for_picture(self, display, complaint):
        """Waits until there is no complaint about the picture."""
        complaints = []

        def fine():
            complaints.append(complaint(display.picture()))
            return not complaints[-1]

        try:
            wait_until(fine, 'a right picture', TIMEOUT)
        except AssertionError as error:
            raise AssertionError('%s: %s' % (error, complaints[-1]))
        finally:
            if complaint == self.missing_handles and 'RVIZ_TEST_PICTURE' in os.environ:
                display.save(os.environ['RVIZ_TEST_PICTURE'])

    def missing_handles(self, picture):
        """What is wrong with a picture in which each handle should fill its place, and its color be nowhere else."""
        arrived = self.handles.messages()
        if not arrived or not arrived[-1].handles:
            return 'no handles were published'
        found, hands = colored(picture), bluish(picture)
        view = View()
        elsewhere = ~view.near([(0, 0, 0)], 0.12)  # there are the axes of the frame
        for handle in arrived[-1].handles:
            points = axis_points(handle)
            inside = view.near(points, 0.7 * handle.radius)
            free = inside & ~hands
            if found[free].mean() < 0.5 or free.sum() < 0.25 * inside.sum():
                return 'of the %d pixels of handle %d, %d are colored and %d hidden by hand poses' % (
                    inside.sum(), handle.id, found[inside].sum(), (inside & hands).sum())
            elsewhere &= ~view.near(points, handle.inner_radius + 0.02)
        if found[elsewhere].sum() > 0.05 * found.sum():
            return '%d of %d colored pixels are at no handle' % (found[elsewhere].sum(), found.sum())
        return ''

    def stale_handles(self, picture):
        """What is wrong with a picture in which a cloud should be shown and no handle."""
        elsewhere = ~View().near([(0, 0, 0)], 0.12)
        left = colored(picture)[elsewhere].sum()
        if (picture.min(axis=2) > 60).mean() < 0.1:
            return 'no cloud is shown'
        return '%d pixels are colored still' % left if left else ''


if __name__ == '__main__':
    rospy.init_node('rviz_test')
    rostest.rosrun('grasp_affordances', 'rviz', Rviz)
