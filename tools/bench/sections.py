"""The sections of the benchmark, in the order of the page.

A section is a module of this folder with

    NAME            what --section takes, and the first word of its points' ids
    points(quick)   list of bench.points.Point; few and fast ones when `quick`
    page(results)   (lines of Markdown, list of bench.figures.Figure). A result is a dict: see bench.results
    measure(point)  only where a point is not a run of a chapter: the dict that bench.runner.measure would give
    prepare()       only where something has to be installed before points() is asked
    ON_REQUEST      True where it is measured only by --section NAME or --NAME
"""
from bench import error, growth, peers, skips

ALL = [
    error,
    skips,
    growth,
    peers,
]


def named(name):
    return next((section for section in ALL if section.NAME == name), None)


def names():
    return [section.NAME for section in ALL]
