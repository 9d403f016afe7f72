"""The rules of the house hold in this tree; and each rule finds what it is there to find in a broken one."""
import unittest

from temporary_tree import ROOT, TreeTest

import rules


class RealTreeTest(unittest.TestCase):
    def testEveryRuleHolds(self):
        for rule in rules.ALL:
            with self.subTest(rule.__name__):
                self.assertEqual(rule(ROOT), [])


class BrokenTreeTest(TreeTest):
    """A tree in which every rule holds, and one break at a time."""

    def setUp(self):
        super().setUp()
        for number, name in enumerate(("00_a", "01_b")):
            self.write(f"chapters/{name}/main.cpp", '#include "common/gl/x.h"\n' + "int i;\n" * (80 + number))
            self.write(f"docs/{name}.md", f"# {name[:2]} A\n\nIdea.\n\n**Estimates** V; **exact answer:** a ray.\n")
            self.write(f"tests/image/{name}_test.cpp", f'#include "chapters/{name}/b.h"\n#include <gtest/gtest.h>\n')
            self.write(f"chapters/{name}/b.h", "int b;\n")
            self.write(f"shaders/{name}/b.glsl", '#include "common/c.glsl"\nfloat b;\n')
        self.write("shaders/common/c.glsl", "float c;\n")
        self.write("common/gl/x.h", "#include <GL/gl.h>\n")
        self.write("common/truth/t.cpp", "#include <embree3/rtcore.h>\n#include <tbb/parallel_for.h>\n")
        for rule in rules.ALL:
            self.assertEqual(rule(self.root), [], rule.__name__)

    def expect(self, rule, *words):
        broken = "\n".join(rule(self.root))
        self.assertTrue(broken, "the rule found nothing")
        for word in words:
            self.assertIn(word, broken)

    def testCommonIncludesAChapter(self):
        self.write("common/gl/y.h", '\n#include "chapters/00_a/b.h"\n')
        self.expect(rules.includes, "common/gl/y.h:2: may not include chapters/00_a/b.h")

    def testAChapterIncludesALaterOne(self):
        self.write("chapters/00_a/c.h", '#include "chapters/01_b/b.h"\n')
        self.expect(rules.includes, "chapters/00_a/c.h:1")

    def testAnEarlierChapterMayBeIncluded(self):
        self.write("chapters/01_b/c.h", '#include "chapters/00_a/b.h"\n')
        self.assertEqual(rules.includes(self.root), [])

    def testAShaderIncludesALaterChapter(self):
        self.write("shaders/00_a/c.glsl", '#include "01_b/b.glsl"\n')
        self.expect(rules.includes, "shaders/00_a/c.glsl:1")
        self.write("shaders/00_a/c.glsl", "")
        self.write("shaders/common/d.glsl", '#include "00_a/b.glsl"\n')
        self.expect(rules.includes, "shaders/common/d.glsl:1")

    def testALowerFolderOfCommonIncludesAHigherOne(self):
        self.write("common/math/m.h", '#include "common/gl/x.h"\n')
        self.expect(rules.includes, "common/math/m.h:1")

    def testOnlyTheGpuSceneJoinsSceneAndOpenGl(self):
        self.write("common/scene/gpu_scene.h", '#include "common/gl/x.h"\n')
        self.assertEqual(rules.includes(self.root), [])
        self.write("common/scene/scene.h", '#include "common/gl/x.h"\n')
        self.expect(rules.includes, "common/scene/scene.h:1")

    def testProgramsIncludeTestsOrARelativePath(self):
        self.write("common/app/a.cpp", '#include "tests/image/00_a_test.cpp"\n#include "x.h"\n')
        self.expect(rules.includes, "common/app/a.cpp:1", "common/app/a.cpp:2: there is no x.h")

    def testALibraryIsIncludedWhereItDoesNotBelong(self):
        for path, header in (("chapters/00_a/b.h", "embree4/rtcore.h"), ("common/image/i.h", "OpenImageIO/imageio.h"),
                             ("chapters/00_a/b.h", "tiny_gltf.h"), ("common/app/p.h", "nlohmann/json.hpp"),
                             ("common/gl/g.cpp", "thread"), ("common/gl/g.cpp", "oneapi/tbb/parallel_for.h"),
                             ("chapters/00_a/b.h", "GLFW/glfw3.h"), ("common/scene/s.cpp", "CLI/CLI.hpp")):
            with self.subTest(header):
                self.write(path, f"#include <{header}>\n")
                self.expect(rules.libraries, f"{path}:1: <{header}> belongs in")

    def testANameIsMissing(self):
        for path in ("docs/00_a.md", "tests/image/01_b_test.cpp"):
            (self.root / path).unlink()
        self.expect(rules.names, "docs/00_a.md is missing", "tests/image/01_b_test.cpp is missing")

    def testANameIsLeftOver(self):
        for path in ("docs/02_c.md", "shaders/03_d/x.glsl", "tests/image/04_e_test.cpp", "chapters/05_f/f.h"):
            self.write(path, "")
        self.expect(rules.names, "chapters/02_c/", "chapters/03_d/", "chapters/04_e/", "chapters/05_f/")

    def testANumberIsTakenTwice(self):
        for path in ("docs/01_c.md", "tests/image/01_c_test.cpp", "chapters/01_c/main.cpp"):
            self.write(path, "")
        self.expect(rules.names, "two chapters have the number 01")

    def testAMainIsTooShortOrTooLong(self):
        self.write("chapters/00_a/main.cpp", "x\n" * 59)
        self.write("chapters/01_b/main.cpp", "x\n" * 181)
        self.expect(rules.mainLength, "00_a/main.cpp has 59 lines", "01_b/main.cpp has 181 lines")

    def testAStepIsLargeAndThePageDoesNotSayWhy(self):
        self.write("chapters/01_b/idea.cpp", "".join(f"// why\nint i{n};\n\n" for n in range(90)))
        self.expect(rules.steps, "docs/01_b.md: 91 lines are new since 00_a")
        self.write("docs/01_b.md", self.read("docs/01_b.md") + "\n**A larger step:** it has to be.\n")
        self.assertEqual(rules.steps(self.root), [])

    def testAPageHasNoHead(self):
        self.write("docs/00_a.md", "# 00 A\n\nIdea.\n")
        self.expect(rules.heads, "docs/00_a.md:1: a page begins with")

    def testSomethingIsLeftToDo(self):
        self.write("common/gl/y.h", "// TO" + "DO: all of it\n")
        self.expect(rules.leftovers, "common/gl/y.h:1: something is left to do")

    def testAnAbsolutePath(self):
        self.write("docs/x.md", "see /ho" + "me/me/notes\n")
        self.expect(rules.leftovers, "docs/x.md:1: an absolute path")


if __name__ == "__main__":
    unittest.main()
