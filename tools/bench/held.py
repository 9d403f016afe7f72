"""What docs/benchmark.md is made of: points measured with the programs as they are; and of sections that are measured on
request alone what the page holds of them, from the day on which they were, until they are measured again as a whole."""
import build
from bench import document, results, sections, store


def onRequest(section):
    return getattr(section, "ON_REQUEST", False)


def measured(chosen):
    """(results of the points of `chosen` sections that are measured with the programs as they are, how many are not)."""
    held, found, missing = store.load(), [], 0
    for section in chosen:
        for point in dict.fromkeys(section.points(False)):
            samples = held.get((point.id, store.digest(point)))
            if samples:
                found.append(results.merge(point, samples))
            else:
                missing += 1
    return found, missing


def page():
    """(machine, results) of the page as it is; None where there is none."""
    file = build.ROOT / "docs" / "benchmark.json"
    return document.read(file.read_text()) if file.is_file() else None


def requested(section, old):
    """(machine, results) of a section on request: as measured now, or what the page holds where that is more."""
    fresh, _ = measured([section])
    kept = [result for result in old[1] if result["section"] == section.NAME] if old else []
    if len(fresh) >= len(kept):
        return results.machine(fresh), fresh
    return old[0]["requested"][section.NAME], kept


def content(old):
    """(machine, results, how many points of the other sections are missing), for a page that is `old` so far.

    machine["requested"]: {section's name: its own machine}. Where points are missing the other sections stay as they are;
    machine is None where there are none to stay.
    """
    always = [section for section in sections.ALL if not onRequest(section)]
    found, missing = measured(always)
    if not missing:
        machine = results.machine(found)
    elif old:
        machine, found = dict(old[0]), [r for r in old[1] if r["section"] in {section.NAME for section in always}]
    else:
        return None, [], missing
    machine["requested"] = {}
    for section in filter(onRequest, sections.ALL):
        about, more = requested(section, old)
        if more:
            machine["requested"][section.NAME], found = about, found + more
    return machine, found, missing
