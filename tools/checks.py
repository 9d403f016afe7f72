"""The steps of ./test. Each returns (passed, failed) and prints what is wrong and where."""
import json
import os
import subprocess
import sys
import xml.etree.ElementTree as xml
from concurrent.futures import ThreadPoolExecutor

import build
import house
import regions
import tidy

ROOT = build.ROOT
CORES = os.cpu_count() or 1
LINES_OF_A_FAILURE = 60
STRESS_CASES = 100000
SANITIZED_CHAPTERS = ("02_shadow_test", "09_ambient_occlusion")  # those that tests/unit/faults_test.cpp gives bad input


def run(words, **more):
    return subprocess.run([str(word) for word in words], cwd=ROOT, capture_output=True, text=True, errors="replace", **more)


def judge(name, ran):
    """One process as one test."""
    if ran.returncode == 0:
        return 1, 0
    print(f"{(ran.stdout + ran.stderr).strip()}\nFAILED {name} (status {ran.returncode})")
    return 0, 1


def whySkipped(case):
    """Of a test that says itself that it cannot be made here (GTEST_SKIP): its reason. None: it ran, or could not even start."""
    mark = case.find("skipped")
    if mark is None or mark.get("message") != "SKIP_REGULAR_EXPRESSION_MATCHED":
        return None
    lines = (case.findtext("system-out") or "").splitlines()
    reasons = [after for line, after in zip(lines, lines[1:]) if line.endswith(": Skipped")]
    return "; ".join(reasons) or "it does not say why"


def ctest(preset, flags=(), targets=(), environment=None):
    """Builds a preset and runs its tests. Who is not root may not mount a disk to fill: a test that needs that is named, and
    counts neither as passed nor as failed."""
    build.build(preset, targets)
    results = build.folder(preset) / "tests.xml"
    results.unlink(missing_ok=True)
    ran = run(["ctest", "--test-dir", build.folder(preset), "-j", CORES, "--no-tests=error", "--output-junit", results, *flags],
              env={**os.environ, **(environment or {})})
    if not results.exists():
        raise build.BuildError(f"{ran.stdout}{ran.stderr}ctest could not run in {build.folder(preset)}")
    cases = xml.parse(results).getroot().findall("testcase")
    skips = [case for case in cases if whySkipped(case)]
    for case in skips:
        print(f"SKIPPED {case.get('name')}: {whySkipped(case)}")
    failures = [case for case in cases if case.get("status") != "run" and case not in skips]
    for case in failures:
        said = (case.findtext("system-out") or "").strip().splitlines()
        print("\n".join(said[-LINES_OF_A_FAILURE:]) + f"\nFAILED {case.get('name')}")
    failed = len(failures) or int(ran.returncode != 0)
    return len(cases) - len(failures) - len(skips), failed


def pages(flags):
    return judge("docs/refresh " + " ".join(flags), run([ROOT / "docs" / "refresh", *flags]))


def cppFiles(*suffixes):
    return [path for path in regions.trackedFiles(ROOT, "common", "chapters", "assets", "tests")
            if path.endswith(suffixes)]


def formatting():
    ran = run(["clang-format", "--dry-run", *cppFiles(".cpp", ".h")])
    wrong = sorted({line.split(":")[0] for line in ran.stderr.splitlines() if "[-Wclang-format-violations]" in line})
    if ran.returncode != 0 or wrong:
        print(f"FAILED format: clang-format -i {' '.join(wrong) or ran.stderr}")
        return 0, 1
    return 1, 0


def lint():
    """clang-tidy on what a reader reads and runs; the checks are in .clang-tidy. Tests are compiled with every warning, run,
    and run again under the sanitizers: reading them too would take longer than all the rest."""
    build.configure("release")
    linter = tidy.Linter(ROOT, build.folder("release"))
    files = [path for path in cppFiles(".cpp") if linter.compiles(path) and not path.startswith("tests/")]
    with ThreadPoolExecutor(CORES) as pool:
        complaints = [said for said in pool.map(linter.complaint, files) if said]
    print("\n".join(complaints), end="\n" if complaints else "")
    return (1, 0) if not complaints else (0, 1)


def sanitizers():
    units = [f"unit_{path.stem.removesuffix('_test')}" for path in sorted((ROOT / "tests" / "unit").glob("*_test.cpp"))]
    targets = [*units, *SANITIZED_CHAPTERS, "make_assets"]
    environment = {
        # Drivers and LLVM keep what they allocate until the process ends: leaks are looked for in our own code only.
        "LSAN_OPTIONS": f"suppressions={ROOT}/tools/leaks.txt:print_suppressions=0",
        "UBSAN_OPTIONS": "print_stacktrace=1",
        "PENUMBRA_TEST_OUTPUT": str(build.folder("sanitize") / "images"),
    }
    # The assets are those of the release build: instrumented code rounds the last bit of a sine differently. Slow suites do what
    # the others do, more often.
    flags = ["-L", "unit", "-LE", "slow", "-E", "ByteForByte|unit_chapter_cli"]
    passed, failed = ctest("sanitize", flags, targets, environment)
    # Mistakes in what a whole chapter is given. Leaks are not looked for here: once in a hundred starts the leak checker itself
    # crashes while a driver's threads end ("Tracer caught signal 11"). Limits of memory are left to the release build: they are
    # below what instrumented code takes.
    chapters = "|".join(SANITIZED_CHAPTERS)
    mistakes = rf"RefusesEveryParameter.*({chapters})|FaultsSlow\.(AFullOrReadOnlyDisk|NonsenseInTheEnvironmentIsNamed)"
    good, bad = ctest("sanitize", ["-R", mistakes], targets, {**environment, "ASAN_OPTIONS": "detect_leaks=0"})
    return passed + good, failed + bad


def withoutOsmesa():
    """The build and a picture on a machine without OSMesa's header and library."""
    chapter = "02_shadow_test"
    build.build("no-osmesa", [chapter])
    program, report = build.folder("no-osmesa") / "bin" / chapter, build.folder("no-osmesa") / "report.json"
    flags = ["--headless", "--scene", "contact", "--size", "64x64"]
    passed, failed = judge("a picture without OSMesa", run([program, *flags, "--report", report]))
    if passed and json.loads(report.read_text())["backend"] != "egl":
        print("FAILED the build without OSMesa did not choose EGL")
        passed, failed = 0, 1
    refused = run([program, *flags, "--backend", "osmesa"])
    if refused.returncode == 1 and len(refused.stderr.strip().splitlines()) == 1:
        return passed + 1, failed
    print(f"{refused.stderr}FAILED --backend osmesa without OSMesa: status {refused.returncode}, one line and 1 expected")
    return passed, failed + 1


def endurance():
    """What ./test does with some hundred frames and two dozen kills, for as long as it takes to find a slow leak."""
    names = ["endurance_chapters", "unit_faults"]
    build.build("release", [*names, "make_assets", *house.chapterNames(ROOT)])  # who is killed is a chapter's program
    passed = failed = 0
    for name, more in zip(names, ({"PENUMBRA_ENDURANCE_FRAMES": "10000"}, {"PENUMBRA_KILLS": "200"})):
        ran = run([build.folder("release") / "bin" / name], env={**os.environ, **more})
        print("\n".join(line for line in ran.stdout.splitlines() if " frames: " in line))
        good, bad = judge(name, ran)
        passed, failed = passed + good, failed + bad
    return passed, failed


def stress(seed):
    """Every subject of tests/stress over many cases. It says itself how far it is; the report stays in out/stress.json, and
    tools/stress_page.py makes a page of it."""
    build.build("release", ["stress"])
    report = ROOT / "out" / "stress.json"
    report.unlink(missing_ok=True)
    program = build.folder("release") / "bin" / "stress"
    status = subprocess.run([program, "--cases", str(STRESS_CASES), "--seed", str(seed), "--report", report,
                             "--kept", ROOT / "tests" / "stress" / "kept.txt"], cwd=ROOT).returncode
    if not report.exists():
        print(f"FAILED {program} (status {status})")
        return 0, 1
    done = json.loads(report.read_text())
    failed = done["failed"] or int(status != 0)
    return done["cases"] - done["failed"], failed


def fuzz(seconds):
    """Each libFuzzer target for `seconds`, from its seed corpus; what it finds stays in out/fuzz."""
    sources = sorted((ROOT / "tests" / "fuzz").glob("*_fuzz.cpp"))
    names = [path.stem.removesuffix("_fuzz") for path in sources]
    build.build("fuzz", [f"fuzz_{name}" for name in names])
    passed = failed = 0
    for name in names:
        found, seeds = ROOT / "out" / "fuzz" / name, ROOT / "tests" / "fuzz" / "corpus" / name
        corpus = build.folder("fuzz") / "corpus" / name
        for folder in (found, corpus):
            folder.mkdir(parents=True, exist_ok=True)
        good, bad = judge(f"fuzz_{name}: the input is in {found}", run(
            [build.folder("fuzz") / "bin" / f"fuzz_{name}", f"-max_total_time={seconds}", "-timeout=10", "-rss_limit_mb=2048",
             "-print_final_stats=1", "-verbosity=0", f"-artifact_prefix={found}/", corpus, seeds]))
        passed, failed = passed + good, failed + bad
    if not names:
        print("there is no fuzz target in tests/fuzz", file=sys.stderr)
    return passed, failed or int(not names)
