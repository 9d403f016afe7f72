"""What is measured: one command line of one chapter, and where it stands on which curve."""
from dataclasses import dataclass


@dataclass(frozen=True)
class Point:
    section: str    # "error"
    scene: str      # "knot": as --scene takes it
    technique: str  # "05 jittered": the curve it belongs to
    chapter: str    # the program: "05_jittered_disk"
    axis: str       # what the technique turns for quality, or the section for growth: "samples"
    value: float    # where on that axis
    flags: tuple    # further words of the command line; --size among them replaces the runner's
    quantity: str   # what it estimates: techniques of one quantity and scene are compared with each other
    compare: bool = True  # with the exact answer; without, the point is only timed
    most: int = 12        # frames timed in one pass, at most
    once: tuple = ()      # passes of the report that are made once, before the first frame: their time is `once_ms`

    @property
    def id(self):
        return "/".join((self.section, self.scene, self.quantity, self.technique, f"{self.axis}={self.value:g}"))

    def command(self):
        """What one types to make its picture, without what the runner adds."""
        return [self.chapter, "--scene", self.scene, *self.flags]
