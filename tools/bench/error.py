"""Run time against error: every technique over its own quality axis, on several scenes."""
NAME = "error"


def points(quick):
    return []


def page(results):
    return [], []
