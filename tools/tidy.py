"""clang-tidy on one file, remembered by the content of everything it read."""
import hashlib
import json
import re
import subprocess
from functools import lru_cache

import files

PRECOMPILED = re.compile(r" -Winvalid-pch| -fpch-preprocess| -include \S*cmake_pch\.hxx")  # GCC's, which clang cannot read
INCLUDE = re.compile(r'^\s*#\s*include\s+"([^"]+)"', re.MULTILINE)


class Linter:
    def __init__(self, root, built):
        self.root, self.built = root, built
        self.passed = built.parent / "tidy"
        self.passed.mkdir(parents=True, exist_ok=True)
        commands = json.loads(PRECOMPILED.sub("", (built / "compile_commands.json").read_text()))
        files.write(self.passed / "compile_commands.json", json.dumps(commands))
        self.commands = {entry["file"]: entry["command"] for entry in commands}
        version = subprocess.run(["clang-tidy", "--version"], capture_output=True, text=True, check=True).stdout
        self.rules = version + (root / ".clang-tidy").read_text()

    def compiles(self, path):
        return str(self.root / path) in self.commands

    def complaint(self, path):
        """What clang-tidy has to say about a file: "" when it is content."""
        stamp = self.passed / self.digest(path)
        if stamp.exists():
            return ""
        ran = subprocess.run(["clang-tidy", "--quiet", "-p", self.passed, path], cwd=self.root, capture_output=True,
                             text=True)
        if ran.returncode == 0 and not ran.stdout.strip():
            stamp.touch()
            return ""
        return (ran.stdout + ran.stderr).strip()

    def digest(self, path):
        digest = hashlib.sha256((self.rules + self.commands[str(self.root / path)]).encode())
        for file in sorted(self.closure(path)):
            digest.update(file.encode() + (self.root / file).read_bytes())
        return digest.hexdigest()[:32]

    @lru_cache(maxsize=None)
    def included(self, path):
        """Files of the project that a file includes itself; those of libraries do not change under us."""
        found = INCLUDE.findall((self.root / path).read_text(errors="replace"))
        return [file for file in found if (self.root / file).is_file()]

    def closure(self, path):
        seen, todo = {path}, [path]
        while todo:
            for file in self.included(todo.pop()):
                if file not in seen:
                    seen.add(file)
                    todo.append(file)
        return seen
