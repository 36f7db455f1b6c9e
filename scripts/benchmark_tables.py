#!/usr/bin/env python3
"""benchmark_tables.py FRAMES.json STAGES.json: prints what frame_ratios and stage_and_frame_benchmark measured as tables in
Markdown."""

import json
import re
import sys


def table(header, rows):
    print('| %s |' % ' | '.join(header))
    print('|%s' % ('---|' * len(header)))
    for row in rows:
        print('| %s |' % ' | '.join(row))
    print()


def times(milliseconds):
    return '%.1f' % milliseconds if milliseconds < 100.0 else '%.0f' % milliseconds


def frame_rows(frames):
    for name, frame in frames.items():
        if frame['pipeline'] == 'textbook':
            continue
        neighborhood = '%.1f cm' % (100.0 * frame['capture_radius'])
        if frame['neighborhood'] == 'knn':
            neighborhood = '500 nearest'
        preset = frame['pipeline'] + ('' if frame['occlusion_filter'] else ', no filter')
        textbook = frames.get(re.sub('^paper', 'textbook', name), {'pipeline': ''})
        ratio = ('', '')
        if textbook['pipeline'] == 'textbook':
            ratio = (times(textbook['milliseconds']), '%.1f' % (textbook['milliseconds'] / frame['milliseconds']))
        estimator = frame['estimator'] + (', sparse' if 'sparse' in name else '')
        yield (preset, estimator, neighborhood, str(frame['samples']), str(frame['threads']),
               times(frame['milliseconds']), '%.2f' % frame['microseconds_per_sample'], *ratio)


def stage_times(benchmarks):
    """{cloud: {stage: microseconds}}"""
    clouds = {}
    for benchmark in benchmarks:
        if benchmark.get('aggregate_name') == 'median':
            _, cloud, stage = benchmark['run_name'].split('/', 2)
            clouds.setdefault(cloud, {})[stage] = benchmark['cpu_time']
    return clouds


def stage_rows(stages):
    for name, microseconds in stages.items():
        if name.endswith('/textbook'):
            continue
        per, stage = name.split('/', 1)
        textbook = stages.get(name + '/textbook')
        ratio = ('', '') if textbook is None else ('%.2f' % textbook, '%.1f' % (textbook / microseconds))
        yield (stage.replace('_', ' '), per, '%.2f' % microseconds, *ratio)


def main():
    with open(sys.argv[1]) as file:
        clouds = json.load(file)
    with open(sys.argv[2]) as file:
        stages = stage_times(json.load(file)['benchmarks'])

    for cloud, measured in clouds.items():
        print('**%s**, %d points; medians, in turns:\n' % (cloud, measured['points']))
        table(('preset', 'estimator', 'neighborhood', 'samples', 'threads', 'ms', 'µs per sample', 'textbook, ms',
               'ratio'), frame_rows(measured['frames']))
        table(('slower : faster', 'ratio'), ((pair, '%.2f' % ratio) for pair, ratio in measured['ratios'].items()))
        table(('stage', 'per', 'µs', 'textbook, µs', 'ratio'), stage_rows(stages[cloud]))


if __name__ == '__main__':
    main()
