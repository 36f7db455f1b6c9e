#!/usr/bin/python3
"""quick_suite_test.py EVALUATE: runs the suite `quick`, compares it with the bounds of bounds.yaml, and makes its page."""

import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

import yaml

HERE = pathlib.Path(__file__).resolve().parent
EVALUATE = sys.argv.pop(1)

# Names of bounds: where the number stands in a result, and whether the bound is the least or the most.
MEASURES = {
    'exactly_one': (('handles', 'exactly_one'), 'least'),
    'handle_precision': (('handles', 'precision'), 'least'),
    'recall': (('shells', 'recall'), 'least'),
    'wrong_handles': (('handles', 'wrong'), 'most'),
}


def name_of(cell):
    return (cell['cell']['row'], cell['cell']['sensor'], cell['cell']['background'])


class QuickSuite(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory(prefix='suite_quick_')
        subprocess.run([EVALUATE, '--suite', 'quick', '--out', cls.folder.name], check=True, stdout=subprocess.DEVNULL)
        with open(os.path.join(cls.folder.name, 'suite.json'), encoding='utf-8') as file:
            cls.cells = json.load(file)['cells']
        with open(HERE / 'bounds.yaml', encoding='utf-8') as file:
            cls.bounds = yaml.safe_load(file)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def test_every_cell_has_bounds_that_a_sentence_holds(self):
        self.assertEqual([name_of(cell) for cell in self.cells], [tuple(bound['cell']) for bound in self.bounds])
        for bound in self.bounds:
            self.assertGreater(len(bound['holds']), 20, bound['cell'])
            self.assertTrue(set(bound) - {'cell', 'holds'}, bound['cell'])

    def test_every_cell_is_within_its_bounds(self):
        for cell, bound in zip(self.cells, self.bounds):
            [result] = cell['results']
            for measure in sorted(set(bound) - {'cell', 'holds'}):
                (part, key), side = MEASURES[measure]
                value = result[part][key]
                with self.subTest(cell=name_of(cell), measure=measure):
                    compare = self.assertGreaterEqual if side == 'least' else self.assertLessEqual
                    compare(value, bound[measure])
                    print('%-32s %-17s %.3f, at %s %s' % ('/'.join(name_of(cell)), measure, value, side,
                                                          bound[measure]))

    def test_every_error_of_an_affordance_has_the_ends_of_its_samples(self):
        for cell in self.cells:
            for error in cell['results'][0]['errors']:
                self.assertTrue(error['cause'])
                if error['kind'] == 'miss':
                    self.assertIn('ends', error)

    def test_the_page_names_pictures_that_exist(self):
        subprocess.run([sys.executable, str(HERE.parents[1] / 'scripts' / 'suite_page.py'), self.folder.name],
                       check=True)
        page = pathlib.Path(self.folder.name, 'index.html').read_text(encoding='utf-8')
        pictures = 0
        for cell in self.cells:
            for error in cell['results'][0]['errors']:
                if 'picture' in error:
                    pictures += 1
                    self.assertIn(error['picture'], page)
                    self.assertTrue(os.path.exists(
                        os.path.join(self.folder.name, cell['pictures'], error['picture'])), error['picture'])
        self.assertGreater(pictures, 20)


if __name__ == '__main__':
    unittest.main()
