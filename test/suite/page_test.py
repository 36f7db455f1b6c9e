#!/usr/bin/python3
"""Whether a click on a number of a suite's page shows the errors behind it, in headless Chromium. Exit status 77, which
is `skipped`, where Chromium is not installed."""

import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

SCRIPTS = pathlib.Path(__file__).resolve().parents[2] / 'scripts'
BROWSER = shutil.which('chromium')
SKIPPED = 77


def numbers(none, several, wrong):
    one = 10 - none - several
    return {
        'frames': 2, 'runs': 1,
        'handles': {'affordances': 10, 'one': one, 'none': none, 'several': several, 'exactly_one': one / 10,
                    'right': one, 'wrong': wrong, 'not_counted': 0, 'precision': one / (one + wrong)},
        'shells': {'affordances': 10, 'found': 9, 'recall': 0.9, 'right': 90, 'wrong': 10, 'precision': 0.9},
        'reliability': [{'from': 0.0, 'to': 0.5, 'right': 1, 'wrong': wrong}],
        'missed': {'affordances': none, 'ends': {'occluded': 4, 'low_curvature': 20}},
    }


def error(kind, cause, what):
    return {'kind': kind, 'cause': cause, 'scene': 'mugs', 'seed': 101, 'run': 1, 'runs': 1, 'what': what,
            'picture': '%s.png' % kind}


def cell(background, *errors):
    result = dict(numbers(none=1, several=1, wrong=2), preset='localizer', samples=2000, errors=list(errors),
                  scenes=[dict(numbers(none=1, several=1, wrong=2), scene='mugs')])
    return {'cell': {'row': 'mugs', 'sensor': 'xtion', 'background': background, 'capture_radius': 0.026},
            'seconds': 12, 'pictures': 'pictures/' + background, 'results': [result]}


SUITE = {'suite': 'test', 'cells': [
    cell('walls', error('miss', 'missed: low_curvature', 'the handle before walls')),
    cell('open', error('miss', 'missed: low_curvature', 'a <b>handle</b> </script> before nothing'),
         error('wrong-handle', 'wrong handle on table', 'an edge of the table')),
]}


@unittest.skipIf(BROWSER is None, 'Chromium is not installed')
class Page(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory(prefix='suite_page_')
        with open(os.path.join(self.folder.name, 'suite.json'), 'w', encoding='utf-8') as file:
            json.dump(SUITE, file)
        subprocess.run([sys.executable, str(SCRIPTS / 'suite_page.py'), self.folder.name], check=True)

    def tearDown(self):
        self.folder.cleanup()

    def errors_after(self, script):
        """What the page shows below its tables once it has run a script of its reader's hand."""
        page = pathlib.Path(self.folder.name, 'index.html').read_text(encoding='utf-8')
        pathlib.Path(self.folder.name, 'clicked.html').write_text(
            page.replace('</html>', '<script>%s</script></html>' % script), encoding='utf-8')
        shown = subprocess.run(
            [BROWSER, '--headless', '--no-sandbox', '--disable-gpu', '--user-data-dir=%s/profile' % self.folder.name,
             '--dump-dom', 'file://%s/clicked.html' % self.folder.name],
            check=True, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, universal_newlines=True, timeout=100).stdout
        begin = shown.index('<div id="errors">')
        return shown[begin:shown.index('<script', begin)]

    def click(self, number, cell_index):
        return self.errors_after(
            'document.querySelector("button[data-cell=\'%d\'][data-show=%s]").click()' % (cell_index, number))

    def test_shows_no_error_before_a_click(self):
        self.assertEqual(self.errors_after('').strip(), '<div id="errors"></div>')

    def test_a_click_shows_the_errors_of_its_cell_by_cause(self):
        shown = self.click('none', 1)
        self.assertIn('mugs, xtion, open, localizer: no handle', shown)
        self.assertIn('missed: low_curvature (1)', shown)
        self.assertIn('a &lt;b&gt;handle&lt;/b&gt; &lt;/script&gt; before nothing', shown)
        self.assertIn('/pictures/open/miss.png', shown)
        self.assertIn('<td>low_curvature</td><td>20</td>', shown)
        self.assertNotIn('before walls', shown)
        self.assertNotIn('an edge of the table', shown)

    def test_a_click_on_another_number_shows_its_errors_instead(self):
        shown = self.errors_after('for (const show of ["none", "wrong"]) '
                                  'document.querySelector(`button[data-cell="1"][data-show=${show}]`).click()')
        self.assertIn('an edge of the table', shown)
        self.assertNotIn('missed: low_curvature', shown)

    def test_a_number_without_errors_says_so(self):
        self.assertIn('No error.', self.click('several', 0))


if __name__ == '__main__':
    if BROWSER is None:
        print('skipped: Chromium is not installed')
        sys.exit(SKIPPED)
    unittest.main()
