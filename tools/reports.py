"""Runs the course's programs for the pages: reports, pictures and parameter lists, each computed once."""
import hashlib
import json
import shlex
import subprocess
import threading
from functools import lru_cache
from pathlib import Path

from markers import PageError


class Programs:
    """The programs of one build. Results are kept under the build folder, by the content of everything that made them."""

    def __init__(self, root, build):
        self.root = Path(root)
        self.folder = self.root / build / "bin"
        self.cache = self.root / build / "docs_cache"

    def report(self, command, where):
        """The JSON report of a chapter's command line, or the JSON of a benchmark's."""
        program = self.program(command, where)
        if program.name.endswith("_bench"):
            flags = ["--benchmark_out_format=json", "--benchmark_out={}"]
        else:
            flags = ["--headless", "--report", "{}"]
        return json.loads(self.run(command, where, flags, ".json"))

    def picture(self, command, where):
        """Path of the PNG file that the command line renders."""
        self.run(command, where, ["--headless", "--output", "{}"], ".png")
        return self.resultFile(command, ".png")

    def parameters(self, chapter, where):
        program = self.program(chapter, where)
        ran = subprocess.run([program, "--list-parameters"], cwd=self.root, capture_output=True, text=True)
        if ran.returncode != 0:
            raise PageError(f"{where}: {chapter} --list-parameters failed: {ran.stderr.strip()}")
        listed = json.loads(ran.stdout)
        return listed["parameters"] if isinstance(listed, dict) else listed

    def program(self, command, where):
        words = shlex.split(command)
        if not words:
            raise PageError(f"{where}: there is no command line")
        path = self.folder / words[0]
        if "/" in words[0] or not path.is_file():
            raise PageError(f"{where}: there is no program {words[0]} in {self.folder.relative_to(self.root)}: "
                            "build first (./run --build), or mend its name")
        return path

    def resultFile(self, command, suffix):
        program = self.program(command, command)
        key = "\0".join([suffix, *shlex.split(command), fileDigest(program), inputsDigest(self.root)])
        return self.cache / (hashlib.sha256(key.encode()).hexdigest()[:24] + suffix)

    def run(self, command, where, outputFlags, suffix):
        """Bytes of the file that the program wrote."""
        program = self.program(command, where)
        result = self.resultFile(command, suffix)
        if not result.is_file():
            result.parent.mkdir(parents=True, exist_ok=True)
            temporary = result.with_name(f"new_{threading.get_ident()}_{result.name}")  # two pages may want the same
            flags = [flag.replace("{}", str(temporary)) for flag in outputFlags]
            words = [program, *shlex.split(command)[1:], *flags]
            ran = subprocess.run(words, cwd=self.root, capture_output=True, text=True)
            if ran.returncode != 0 or not temporary.is_file():
                said = (ran.stderr.strip() or ran.stdout.strip() or "nothing").splitlines()[-1]
                raise PageError(f"{where}: `{command}` ended with status {ran.returncode}, saying: {said}")
            temporary.replace(result)
        return result.read_bytes()


@lru_cache(maxsize=None)
def fileDigest(path):
    return hashlib.sha256(Path(path).read_bytes()).hexdigest()


@lru_cache(maxsize=None)
def inputsDigest(root):
    """Of what programs read at run time: shaders and assets."""
    digest = hashlib.sha256()
    for folder in ("shaders", "assets"):
        for path in sorted((Path(root) / folder).rglob("*")):
            if path.is_file():
                digest.update(f"{path.relative_to(root)} {fileDigest(path)}\n".encode())
    return digest.hexdigest()
