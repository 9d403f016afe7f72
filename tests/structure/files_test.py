"""What the tools write is whole or absent, and what they cannot write is said in one line."""
import contextlib
import io
import os
import signal
import subprocess
import sys
import unittest
from unittest import mock

from temporary_tree import ROOT, TreeTest

import build
import files
import gallery
import run_command
import test_command

# Kills itself when half of the file is written.
KILLED = """
import os, pathlib, signal, sys
sys.path.insert(0, {tools!r})
import files
real = pathlib.Path.write_bytes
def half(path, data):
    real(path, data[:len(data) // 2])
    os.kill(os.getpid(), signal.SIGKILL)
pathlib.Path.write_bytes = half
files.write(pathlib.Path({target!r}), "the new text")
"""


class FilesTest(TreeTest):
    def testMakesFoldersAndLeavesNothingElse(self):
        files.write(self.root / "a" / "b.txt", "text")
        files.write(self.root / "a" / "b.txt", b"bytes")
        self.assertEqual(self.read("a/b.txt"), "bytes")
        self.assertEqual(os.listdir(self.root / "a"), ["b.txt"])
        files.requireWritable(self.root / "a" / "c.txt")
        self.assertEqual(os.listdir(self.root / "a"), ["b.txt"])

    def testKilledInTheMiddleTheOldTextIsThereAndTheNextWriteTidiesUp(self):
        self.write("page.md", "the old text")
        killed = subprocess.run([sys.executable, "-c", KILLED.format(tools=str(ROOT / "tools"),
                                                                     target=str(self.root / "page.md"))])
        self.assertEqual(killed.returncode, -signal.SIGKILL)
        self.assertEqual(self.read("page.md"), "the old text")
        files.write(self.root / "page.md", "newer")
        self.assertEqual(os.listdir(self.root), ["page.md"])

    def testAFolderThatCannotBeWrittenIsNamedBeforeAnythingIsRendered(self):
        self.write("out", "a file where a folder should be")
        with mock.patch.object(build, "ROOT", self.root), mock.patch.object(gallery, "renderChapter") as render:
            with self.assertRaises(OSError) as raised:
                gallery.render(["03_a"], "courtyard", "8x8")
        self.assertIn(str(self.root / "out"), str(raised.exception))
        render.assert_not_called()

    def testTheCommandsSayItInOneLine(self):
        problem = OSError(30, "Read-only file system", "out/index.html")
        for command in (run_command, test_command):
            said, printed = io.StringIO(), io.StringIO()
            with self.subTest(command.__name__), mock.patch.object(command, "main", side_effect=problem), \
                    contextlib.redirect_stderr(said), contextlib.redirect_stdout(printed):
                self.assertEqual(command.guarded([]), 1)
                self.assertRegex(said.getvalue(), r"\Aout/index\.html: Read-only file system; [^\n]+\n\Z")

    def testEnduranceIsAStepOfItsOwn(self):
        self.assertEqual([name for name, _ in test_command.chosenSteps(test_command.parse(["--endurance"]))],
                         ["endurance"])


if __name__ == "__main__":
    unittest.main()
