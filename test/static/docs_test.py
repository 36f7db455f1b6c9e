#!/usr/bin/python3
"""docs_test.py SOURCE EXECUTABLES: whether README.md, CONTRIBUTING.md and the pages of docs/ say what is there.

Checked are links, anchors, paths, folders of docs/architecture.md, launch files with their arguments, programs and
their options. Every fault is one line. Exit status 1: there is one.
"""

import os
import re
import subprocess
import sys
import xml.etree.ElementTree as ElementTree

try:
    import roslaunch.config
    import roslaunch.xmlloader
except ImportError:  # outside of ROS
    roslaunch = None

PACKAGE = 'grasp_affordances'
LONGEST_README = 160  # lines
PROGRAMS = ('localize', 'simulate', 'evaluate')
THEIRS = {'config': '', 'hand': 'pr2'}  # launch files load what the reader has there
OPTIONAL = {'moveit_grasps'}  # programs that are built only where what they need is found


def pages(root):
    """Markdown files that the reader is meant to read, as paths below the root."""
    docs = sorted(name for name in os.listdir(os.path.join(root, 'docs')) if name.endswith('.md'))
    return ['README.md', 'CONTRIBUTING.md'] + ['docs/' + name for name in docs]


class Page:
    def __init__(self, root, path):
        self.path = path
        with open(os.path.join(root, path), encoding='utf-8') as file:
            self.lines = file.read().splitlines()
        self.prose, self.blocks = self._split()

    def _split(self):
        """The text without its code blocks, and these: (language, lines). An indented block follows an empty line."""
        prose, blocks, block = [], [], None
        for line in self.lines:
            indented = block is not None and block[0] == 'indented'
            if indented and not line.startswith('    '):
                blocks.append(block)
                block = None
            if block is None and line.startswith('    ') and prose and not prose[-1]:
                block = ('indented', [line])
            elif line.startswith('```'):
                if block is None:
                    block = (line[3:].strip(), [])
                else:
                    blocks.append(block)
                    block = None
            elif block is not None:
                block[1].append(line)
            else:
                prose.append(line)
        return '\n'.join(prose), blocks

    def anchors(self):
        """As GitHub makes them of headings; of equal ones the second has -1 at its end."""
        found = {}
        for line in self.prose.splitlines():
            heading = re.match(r'#+\s+(.*)', line)
            if heading:
                text = re.sub(r'\[([^]]*)\]\([^)]*\)', r'\1', heading.group(1)).replace('`', '').strip().lower()
                anchor = re.sub(r'[^\w\- ]', '', text).replace(' ', '-')
                count = found.get(anchor, 0)
                found[anchor] = count + 1
                if count:
                    found['%s-%d' % (anchor, count)] = 1
        return set(found)

    def links(self):
        """Targets of links and pictures."""
        without_code = re.sub(r'`[^`]*`', lambda code: re.sub(r'[\[\]()]', '', code.group(0)), self.prose)
        return re.findall(r'\]\(\s*([^)\s]+)\s*\)', without_code)

    def code(self):
        """What stands in backticks."""
        return [' '.join(text.split()) for text in re.findall(r'`([^`]+)`', self.prose)]

    def commands(self):
        """Lines of shell blocks and of indented ones, those that go on joined, without comments."""
        for language, lines in self.blocks:
            if language in ('sh', 'bash', 'indented'):
                text = re.sub(r'\\\n\s*', ' ', '\n'.join(lines))
                for line in text.splitlines():
                    yield re.sub(r'(^|\s)#.*', '', line).strip()


def local_faults(root, all_pages):
    """Links, anchors, whether a page can be reached from the README."""
    next_pages = {}
    for path, page in all_pages.items():
        reached = next_pages.setdefault(path, set())
        for link in page.links():
            if re.match(r'[a-z]+:', link):
                continue
            file, _, anchor = link.partition('#')
            target = os.path.normpath(os.path.join(os.path.dirname(path), file)) if file else path
            if not os.path.exists(os.path.join(root, target)):
                yield '%s: the link %s leads nowhere' % (path, link)
            elif anchor and (target not in all_pages or anchor not in all_pages[target].anchors()):
                yield '%s: the link %s leads to no heading' % (path, link)
            elif target in all_pages:
                reached.add(target)
    seen, waiting = {'README.md'}, ['README.md']
    while waiting:
        for target in next_pages[waiting.pop()] - seen:
            seen.add(target)
            waiting.append(target)
    for path in sorted(set(all_pages) - seen):
        yield '%s: no link leads to it from README.md' % path


def exists(root, path):
    """A folder, a file, or a file whose extension is left out; `*` and {a,b} as the shell knows them, or NAME."""
    alternatives = re.fullmatch(r'(.*)\{([^}]*)\}(.*)', path)
    if alternatives:
        before, words, after = alternatives.groups()
        return all(exists(root, before + word + after) for word in words.split(','))
    folder, name = os.path.split(path.rstrip('/'))
    folder = os.path.join(root, folder)
    if not os.path.isdir(folder):
        return False
    pattern = re.escape(name).replace(r'\*', '.*')
    return any(re.fullmatch(pattern + r'(\.[a-z0-9]+)?', entry) for entry in os.listdir(folder))


def path_faults(root, all_pages):
    rooms = r'(src|include|config|launch|scripts|test|docs|msg|srv|cfg|cmake)/[^\s:;,()]*'
    for path, page in all_pages.items():
        for code in page.code() + list(page.commands()):
            for word in re.finditer(r'(?<![\w./$~-])' + rooms, code):
                name = word.group(0).rstrip('.')
                if 'NAME' not in name and not exists(root, name):
                    yield '%s: there is no %s' % (path, name)


def map_faults(root, page):
    """Of docs/architecture.md: every row of the tables of files has all sources of its folder and no others."""
    sources = {}
    for line in page.lines:
        row = re.match(r'\| `(src/(?:core|nodelets)/(?:\w+/)?)` \| ((?:`\w+`(?:, )?)+) \|', line)
        if row:
            sources[row.group(1)] = set(re.findall(r'`(\w+)`', row.group(2)))
    for room in ('src/core/', 'src/nodelets/'):
        for folder, _, files in os.walk(os.path.join(root, room)):
            folder = os.path.relpath(folder, root) + '/'
            there = {os.path.splitext(name)[0] for name in files if name.endswith(('.cpp', '.h'))}
            named = sources.pop(folder, set())
            for name in sorted(there - named):
                yield '%s: %s%s is not on the map' % (page.path, folder, name)
            for name in sorted(named - there):
                yield '%s: %s holds no %s' % (page.path, folder, name)
    for folder in sources:
        yield '%s: there is no %s' % (page.path, folder)


def launch_arguments(root, file):
    """Arguments that may be given to a launch file: those without a value."""
    launch = ElementTree.parse(os.path.join(root, 'launch', file)).getroot()
    return {arg.get('name') for arg in launch.findall('arg') if arg.get('value') is None}


def roslaunch_fault(file, arguments):
    """What `roslaunch --nodes` says against a file with these arguments; empty where it finds nothing wrong."""
    try:
        loader = roslaunch.xmlloader.XmlLoader(resolve_anon=False)
        roslaunch.config.load_config_default([(file, arguments)], None, loader=loader, verbose=False,
                                             assign_machines=False)
        return ''
    except Exception as error:  # of many kinds: roslaunch hands on what it meets
        return ' '.join(str(error).split())


def launch_faults(root, all_pages):
    has_ros = roslaunch is not None and 'ROS_PACKAGE_PATH' in os.environ
    seen = set()
    for path, page in all_pages.items():
        for command in page.commands():
            found = re.search(r'\broslaunch (?:--\S+ )*%s (\S+\.launch)(.*)' % PACKAGE, command)
            if not found:
                continue
            file, rest = found.groups()
            if not os.path.exists(os.path.join(root, 'launch', file)):
                yield '%s: there is no launch/%s' % (path, file)
                continue
            given = re.findall(r'(\w+):=("[^"]*"|\S*)', rest)
            unknown = {name for name, _ in given} - launch_arguments(root, file)
            for name in sorted(unknown):
                yield '%s: launch/%s has no argument %s' % (path, file, name)
            arguments = ['%s:=%s' % (name, THEIRS.get(name, value.strip('"'))) for name, value in given]
            if not has_ros or unknown or (file, *arguments) in seen:
                continue
            seen.add((file, *arguments))
            fault = roslaunch_fault(os.path.join(root, 'launch', file), arguments)
            if fault:
                yield '%s: roslaunch %s %s: %s' % (path, file, ' '.join(arguments), fault)


def options_of(executables, program):
    """None: it is not built, as where CLI11 is missing."""
    path = os.path.join(executables, program)
    if not os.path.exists(path):
        return None
    done = subprocess.run([path, '--help'], stdout=subprocess.PIPE, timeout=60, check=True)
    return set(re.findall(r'(?<![\w-])--?[a-z][\w-]*', done.stdout.decode()))


def program_faults(root, executables, all_pages):
    options = {program: options_of(executables, program) for program in PROGRAMS}
    scripts = set(os.listdir(os.path.join(root, 'scripts')))
    for path, page in all_pages.items():
        for command in list(page.commands()) + page.code():
            for name in re.findall(r'\brosrun %s (\S+)' % PACKAGE, command):
                if name not in OPTIONAL.union(PROGRAMS) and name not in scripts | set(os.listdir(executables)):
                    yield '%s: there is no program %s' % (path, name)
            for part in re.split(r'&&|;|\|', command):
                words = part.split()
                program = os.path.basename(words[0]) if words else ''
                if words[:2] == ['rosrun', PACKAGE] and len(words) > 2:
                    program = words[2]
                if options.get(program) is None or words[0] == 'scripts/' + program:
                    continue  # a script of a program's name has options of its own
                for option in re.findall(r'(?<!\S)--?[a-z][\w-]*', part):
                    if option not in options[program]:
                        yield '%s: %s has no option %s' % (path, program, option)


def length_faults(all_pages):
    lines = len(all_pages['README.md'].lines)
    if lines > LONGEST_README:
        yield 'README.md has %d lines, which is more than %d' % (lines, LONGEST_README)


def main(root, executables):
    all_pages = {path: Page(root, path) for path in pages(root)}
    faults = list(length_faults(all_pages))
    faults += local_faults(root, all_pages)
    faults += path_faults(root, all_pages)
    faults += map_faults(root, all_pages['docs/architecture.md'])
    faults += launch_faults(root, all_pages)
    faults += program_faults(root, executables, all_pages)
    for fault in faults:
        print(fault)
    print('%d pages, %d faults' % (len(all_pages), len(faults)))
    return 1 if faults else 0


if __name__ == '__main__':
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    sys.exit(main(sys.argv[1], sys.argv[2]))
