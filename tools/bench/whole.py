"""A run of a chapter with what all of its process took: a bake is made once, in no frame that is timed."""
import resource
import time

from bench import runner


def childrenCpuMs():
    """Of all children that have ended: the runner waits for each."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return 1e3 * (used.ru_utime + used.ru_stime)


def measure(point, runs):
    """The sample of bench.runner.measure, and in it total_cpu_ms: loading, hierarchies, bakes and all frames. setup_ms is
    then all but the timed frames, so that a long bake is not repeated as a fast point would be."""
    cpu, wall = childrenCpuMs(), time.monotonic()
    sample = runner.measure(point, runs, compare=False)
    sample["total_cpu_ms"] = childrenCpuMs() - cpu
    sample["setup_ms"] = max(0.0, 1e3 * (time.monotonic() - wall) - runs * sample["wall_ms"])
    return sample
