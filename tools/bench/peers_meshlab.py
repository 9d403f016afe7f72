"""MeshLab's filter "Ambient Occlusion": N depth maps of the mesh, drawn by OpenGL, looked up at every vertex.

It needs a display, so it gets one in memory (Xvfb), whose time counts too. A vertex has the mean over all N directions of
the sphere of max(0, n.l) where it is seen: a quarter of the ambient visibility, since half of them are below the horizon,
and the mean cosine of the others is a half.
"""
import os
import re
import subprocess
import tempfile
from pathlib import Path

from bench import export
from bench import peers_jobs as jobs
from bench.peers_curves import figures
from bench.runner import PointError

QUARTER = 4.0
TOOK = re.compile(r"calculated A\.O\. after ([\d.]+) sec")
FILTER = """<!DOCTYPE FilterScript>
<FilterScript>
 <filter name="Ambient Occlusion">
  <Param type="RichEnum" value="0" name="occMode"/>
  <Param type="RichFloat" value="0" name="dirBias"/>
  <Param type="RichInt" value="{views}" name="reqViews"/>
  <Param type="RichPoint3f" x="0" y="1" z="0" name="coneDir"/>
  <Param type="RichFloat" value="30" name="coneAngle"/>
  <Param type="RichBool" value="false" name="useGPU"/>
  <Param type="RichInt" value="{size}" name="depthTexSize"/>
 </filter>
</FilterScript>
"""


def filterScript(views, size):
    return FILTER.format(views=views, size=size)


class Display:
    """An X server without a screen; `cpu_s` once it has ended."""

    def __enter__(self):
        read, write = os.pipe()
        words = ["Xvfb", "-displayfd", str(write), "-screen", "0", "1280x1024x24", "-nolisten", "tcp"]
        self.server = subprocess.Popen(words, pass_fds=[write], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.close(write)
        with os.fdopen(read) as answer:
            number = answer.readline().strip()  # ends at once if the server does
        if not number:
            raise PointError("Xvfb did not start, and MeshLab draws with OpenGL on a display")
        self.name = f":{number}"
        return self

    def __exit__(self, *_):
        self.server.terminate()
        _, status, usage = os.wait4(self.server.pid, 0)
        self.server.returncode = os.waitstatus_to_exitcode(status)
        self.cpu_s = usage.ru_utime + usage.ru_stime


def version():
    """meshlabserver has no flag for it."""
    said = subprocess.run(["dpkg-query", "-W", "-f=${Version}", "meshlab"], capture_output=True, text=True).stdout
    return f"MeshLab {said.partition('+')[0] or 'of unknown version'}"


def meshlab(mesh, script, output):
    """jobs.Used of MeshLab and its display."""
    with tempfile.TemporaryDirectory() as folder:
        words = ["meshlabserver", "-i", mesh, "-o", output, "-m", "vq"]
        if script:
            file = Path(folder) / "filter.mlx"
            file.write_text(script)
            words += ["-s", file]
        display = Display()
        with display:
            used = jobs.run(words, {"DISPLAY": display.name, "XDG_RUNTIME_DIR": folder, "HOME": folder})
    return jobs.Used(used.cpu_s + display.cpu_s, used.wall_s, used.said)


def bake(scene, views, size):
    """A sample: the filter is the whole process without what it takes to read and write the same mesh, without a filter."""
    truth, noise, source = jobs.vertexTruth(scene)
    mesh = Path(jobs.ply(f"{scene}_vertices", truth, source)["file"])
    with tempfile.TemporaryDirectory() as folder:
        output = Path(folder) / "baked.ply"
        idle = meshlab(mesh, None, output)
        used = meshlab(mesh, filterScript(views, size), output)
        took = TOOK.search(used.said)
        if not took or not output.is_file():
            raise PointError(f"MeshLab's filter did not run: {used.said.strip()[-200:]}")
        baked = export.readPly(output)
    if list(baked.positions) != list(truth.positions):
        raise PointError(f"MeshLab wrote {baked.vertices} vertices, and not the {truth.vertices} that it was given")
    errors = [QUARTER * value - exact for value, exact in zip(baked.values, truth.values)]
    sample = jobs.sample(max(used.cpu_s - idle.cpu_s, 1e-3), float(took[1]), used.cpu_s, figures(errors), version=version())
    return jobs.withNoise(sample, noise)
