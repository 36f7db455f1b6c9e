#!/usr/bin/python3
"""Reads the include lines of src, include and test/support, and fails where

* a room includes one that stands above it, or beside it (a room is a folder of src, of src/core or of src/nodelets; an
  installed header belongs to the room of its source),
* files include one another in a circle,
* an installed header needs one that is not installed,
* a file includes one of ours that does not exist.

The tables below are the map: docs/architecture.md explains it.
"""

import pathlib
import re
import sys

# Top floor first. A room may include those on lower floors. Rooms that share a floor do not know one another.
SRC = [['tools', 'python', 'moveit'],
       ['nodelets'],
       ['virtual_device', 'evaluation'],
       ['simulation', 'io', 'rendering', 'openni2'],
       ['core']]
FOLDERS = {
    'core': [['.'],  # the files of the folder itself
             ['hand_poses'], ['handles'], ['views'], ['shell'], ['fit'], ['neighborhoods'], ['tracking'], ['cloud'],
             ['result'], ['config'], ['kernels'], ['parallel']],
    'nodelets': [['localizer', 'cameras'], ['selection'], ['messages'], ['parameters'], ['roscpp']],
}
# What the floors would allow: cameras are another library than the localizer.
STRANGERS = {('nodelets/cameras', 'nodelets/selection')}

INSTALLED = {'cancelled': 'core/parallel',
             'cloud': 'core/cloud',
             'config': 'core/config',
             'handle': 'core/result',
             'handle_tracker': 'core/tracking',
             'localization': 'core/result',
             'localizer': 'core/.',
             'parameters': 'core/config',
             'point_cloud2': 'core/cloud'}

GENERATED = 'generated'  # messages, services and the configuration: catkin makes and installs their headers
ABOVE_ALL = 'test/support'
OURS = ['grasp_affordances', 'support'] + [room for floor in SRC for room in floor]
INCLUDE = re.compile(r'^\s*#\s*include\s*(?:"([^"]+)"|<((?:%s)/[^>]+)>)' % '|'.join(OURS))  # in quotes: always ours


class Project:
    def __init__(self, root):
        self.root = root
        self.files = {path.relative_to(root).as_posix()
                      for folder in ('src', 'include', 'test/support')
                      for path in (root / folder).rglob('*') if path.suffix in ('.h', '.cpp')}
        names = {path.stem for folder in ('msg', 'srv', 'cfg') for path in (root / folder).iterdir()}
        self.generated = {'grasp_affordances/%s%s.h' % (name, ending)
                          for name in names for ending in ('', 'Request', 'Response', 'Config')}

    def resolve(self, name):
        """The file, from the root, that an include line names; GENERATED; None where there is none."""
        top = name.split('/')[0]
        path = {'grasp_affordances': 'include/', 'support': 'test/'}.get(top, 'src/') + name
        if path in self.files:
            return path
        return GENERATED if name in self.generated else None

    def includes(self, file):
        """(number of the line, name) of what a file includes of ours."""
        lines = (self.root / file).read_text().splitlines()
        for number, line in enumerate(lines, 1):
            found = INCLUDE.match(line)
            if found:
                yield number, found.group(1) or found.group(2)


def room_of(file):
    """'core/fit', 'io', ...; None where the tables know no such room."""
    if file == GENERATED:
        return GENERATED
    if file.startswith('test/support/'):
        return ABOVE_ALL
    parts = file.split('/')
    if parts[0] == 'include':
        return INSTALLED.get(pathlib.PurePath(file).stem)
    room, below = parts[1], FOLDERS.get(parts[1])
    if not any(room in floor for floor in SRC) or len(parts) < 3:
        return None
    if below is None:
        return room
    folder = parts[2] if len(parts) > 3 else '.'
    return '%s/%s' % (room, folder) if any(folder in floor for floor in below) else None


def floor_of(name, floors):
    return next(number for number, floor in enumerate(floors) if name in floor)


def may_include(room, other):
    if room == other or room == ABOVE_ALL:
        return True
    if other == ABOVE_ALL or (room, other) in STRANGERS or (other, room) in STRANGERS:
        return False
    top = room.split('/')[0]
    if other == GENERATED:  # ROS is for those who stand no lower than the nodelets
        return floor_of(top, SRC) <= floor_of('nodelets', SRC)
    other_top = other.split('/')[0]
    if top != other_top:
        return floor_of(top, SRC) < floor_of(other_top, SRC)
    folder, other_folder = room.split('/')[1], other.split('/')[1]
    return floor_of(folder, FOLDERS[top]) < floor_of(other_folder, FOLDERS[top])


def find_circle(graph):
    """A list of files, each of which includes the next, the last the first; empty where there is none."""
    done, path = set(), []

    def visit(file):
        if file in path:
            return path[path.index(file):]
        if file in done:
            return []
        path.append(file)
        for other in graph.get(file, []):
            circle = visit(other)
            if circle:
                return circle
        path.pop()
        done.add(file)
        return []

    for file in sorted(graph):
        circle = visit(file)
        if circle:
            return circle
    return []


def check(root):
    """What is wrong, one line each."""
    project = Project(root)
    wrong, graph = [], {}
    for file in sorted(project.files):
        room = room_of(file)
        if room is None:
            wrong.append('%s: stands in no room of the tables in %s' % (file, pathlib.Path(__file__).name))
            continue
        for number, name in project.includes(file):
            where = '%s:%d: ' % (file, number)
            other = project.resolve(name)
            if other is None:
                wrong.append(where + 'there is no %s' % name)
                continue
            graph.setdefault(file, []).append(other)
            if file.startswith('include/') and other != GENERATED and not other.startswith('include/'):
                wrong.append(where + 'an installed header needs %s, which is not installed' % name)
            other_room = room_of(other)
            if other_room is not None and not may_include(room, other_room):
                wrong.append(where + '%s may not use %s (%s)' % (room, other_room, name))
    circle = find_circle(graph)
    if circle:
        wrong.append('a circle: ' + ' -> '.join(circle + circle[:1]))
    return wrong, graph


def main():
    root = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).resolve().parents[2])
    wrong, graph = check(root)
    for line in wrong:
        print(line)
    lines = sum(len(others) for others in graph.values())
    print('%d include lines of %d files: %d wrong' % (lines, len(graph), len(wrong)))
    return 1 if wrong or not lines else 0


if __name__ == '__main__':
    sys.exit(main())
