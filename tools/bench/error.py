"""Section `error`: run time against error, every technique over its own quality axis, on several scenes."""
import statistics

import tables
from bench import curves, estimates, techniques, work
from bench.figures import Curve, Figure

NAME = "error"
LEVELS = (0.1, 0.03, 0.01, 0.003)
# Plots that the page shows; all lie in out/bench.
SHOWN = (("hard", "courtyard"), ("box", "contact_panel"), ("disk", "contact_panel"), ("area", "heckbert_herf"),
         ("area", "knot"), ("ambient", "knot"), ("sky", "contact"))


def points(quick):
    return techniques.allPoints(quick)


def scenesOf(results, quantity):
    """In the order of the points."""
    return [scene for scene in dict.fromkeys(result["scene"] for result in results)
            if estimates.curvesOf(results, scene, quantity)]


def drawnCurves(every, quantity):
    """[(look, curve), ...]: those that estimate the quantity, and the filters, which do not, as one."""
    own = techniques.namesOf(quantity)
    filters = [curve for curve in every if curve.technique not in own]
    drawn = [(own.index(curve.technique), curve) for curve in every if curve.technique in own]
    return drawn + [(len(own), estimates.together(filters, f"best of {len(filters)} filters"))] if filters else drawn


def figure(every, scene, quantity):
    """Curves with their slopes; marked: no other point is as quick and as right."""
    looks, drawn = drawnCurves(every, quantity), []
    best = curves.front([curve for _, curve in looks])
    for look, curve in looks:
        kept = [(i, point) for i, point in enumerate(curve.points) if point[1] >= curves.EXACT]
        steep = curves.slope([point for _, point in kept])
        if kept:
            marked = [at for at, (i, _) in enumerate(kept) if (curve.technique, i) in best]
            label = curve.technique if steep is None else f"{curve.technique} ({curves.shownSlope(steep)})"
            drawn.append(Curve(label, [point[:2] for _, point in kept], marked, look=look))
        if exact := curve.exact():
            drawn.append(Curve(f"{curve.technique}: exact", [(exact[0], None)], dashed=True, look=look))
    quantityTitle = techniques.quantity(quantity).title
    return Figure(f"error_{quantity}_{scene}", f"{scene}: {quantityTitle}", "ms a frame", "root mean square error", drawn,
                  (quantity, scene) in SHOWN, scene, quantity)


def milliseconds(ms):
    return f"{ms:.3g}" if ms < 1000 else f"{ms:.0f}"


def levelRow(every, scene, quantity, level):
    """Cells of one scene and error: what is cheapest, by how much, and the alternative a reader would otherwise pick."""
    reached = estimates.reaching(every, level)
    if level < estimates.limitOf(every, quantity):
        return [scene, f"{level:g}", "cannot be told: the exact answer's own noise is as large"] + 5 * ["–"]
    first, cells = reached[0], ["no other", "–"]
    if len(reached) > 1:
        cells = [reached[1][1], f"{reached[1][0] / first[0]:.1f}"]
    other = next((ms for ms, technique, _ in reached if technique == techniques.quantity(quantity).alternative), None)
    cells += ["–", "–"] if other is None else [milliseconds(other), f"{other / first[0]:.1f}"]
    return [scene, f"{level:g}", first[1], milliseconds(first[0]), *cells]


def nobodysRow(every, scene, quantity, levels):
    """Cells of the errors that no technique reaches, and of the one that comes nearest."""
    error, ms, technique, result = estimates.best(every)
    bias = estimates.errorFigures(result, quantity)["bias"] / techniques.quantity(quantity).unit
    # Of a root mean square, a tenth of it as bias is half a per cent.
    said = f"bias {bias:+.1g}" if abs(bias) > 0.1 * error else "hardly any of it bias"
    return [scene, ", ".join(f"{level:g}" for level in levels), f"none; {technique} comes to {error:.2g}, {said}",
            milliseconds(ms)] + 4 * ["–"]


def sceneRows(every, scene, quantity):
    missed = [level for level in LEVELS if not estimates.reaching(every, level)]
    rows = [levelRow(every, scene, quantity, level) for level in LEVELS if level not in missed]
    return rows + ([nobodysRow(every, scene, quantity, missed)] if missed else [])


def levelTable(results, quantity):
    alternative = techniques.quantity(quantity).alternative
    rows = []
    for scene in scenesOf(results, quantity):
        rows += sceneRows(estimates.curvesOf(results, scene, quantity), scene, quantity)
    headings = ["scene", "error", "cheapest", "ms", "runner-up", "times the ms", f"{alternative}, ms", "times the ms"]
    shown = len(headings) if alternative else len(headings) - 2
    alignment = ["---", "---:", "---", "---:", "---", "---:", "---:", "---:"]
    return tables.markdown(headings[:shown], [row[:shown] for row in rows], alignment[:shown])


def glanceRows(results, quantity):
    """How often each technique is cheapest, and by what factors: medians over scenes and errors."""
    won = {}
    for scene in scenesOf(results, quantity.name):
        every = estimates.curvesOf(results, scene, quantity.name)
        for level in LEVELS:
            reached = estimates.reaching(every, level)
            if reached and level >= estimates.limitOf(every, quantity.name):
                won.setdefault(reached[0][1], []).append(reached)
    cases, rows = sum(map(len, won.values())), []
    for technique, found in sorted(won.items(), key=lambda entry: -len(entry[1])):
        second = [reached[1][0] / reached[0][0] for reached in found if len(reached) > 1]
        other = [entry[0] / reached[0][0] for reached in found for entry in reached
                 if entry[1] == quantity.alternative != technique]
        factor = lambda values: f"{statistics.median(values):.1f}" if values else "–"  # noqa: E731
        rows.append([quantity.title, technique, f"{len(found)} of {cases}", factor(second), factor(other)])
    return rows


def glance(results):
    """The first answer of the page, in one table."""
    rows = [row for quantity in techniques.QUANTITIES for row in glanceRows(results, quantity)]
    headings = ["quantity", "cheapest", "cases", "quicker than the runner-up", "quicker than the rays"]
    return tables.markdown(headings, rows, ["---", "---", "---:", "---:", "---:"])


def winners(results, quantity):
    """{technique: (level, result)} of what is cheapest somewhere, with the hardest case that it wins."""
    found = {}
    for scene in scenesOf(results, quantity):
        every = estimates.curvesOf(results, scene, quantity)
        for level in LEVELS:
            reached = estimates.reaching(every, level)
            if reached and level >= estimates.limitOf(every, quantity):
                found[reached[0][1]] = (level, reached[0][2])
    return found


def whyLines(results, quantity):
    """One sentence for each technique, from the table, and of those that win what their counters say."""
    won, lines = winners(results, quantity), []
    own = [result["technique"] for result in results if result["quantity"] == quantity]
    for technique in dict.fromkeys([*own, *won]):
        line = f"- **{technique}**: {techniques.whyOf(technique, quantity)}."
        if technique in won:
            level, result = won[technique]
            said = work.facts(result["work"])
            where = f"At {result['axis']} {result['value']:g} on {result['scene']}, where it is cheapest for {level:g}"
            line += f" ({where}: {said}.)" if said else f" (Cheapest for {level:g} on {result['scene']}.)"
        lines.append(line)
    return lines


def slopeLines(results, quantity):
    """Of the techniques that estimate the quantity: the others' errors are not their samples'."""
    scenes, rows = scenesOf(results, quantity), {}
    for scene in scenes:
        for curve in estimates.curvesOf(results, scene, quantity):
            if curve.technique in techniques.namesOf(quantity):
                rows.setdefault(curve.technique, {})[scene] = curves.shownSlope(curves.slope(curve.drawn()))
    cells = [[technique, *(found.get(scene, "–") for scene in scenes)] for technique, found in rows.items()]
    if all(cell == "–" for row in cells for cell in row[1:]):
        return []
    alignment = ["---", *("---:" for _ in scenes)]
    return ["How error falls with time, as the slope of the line fitted to the curve (random samples: -0.5; –: fewer than "
            "three settings, or all about as quick):", "", tables.markdown(["slope", *scenes], cells, alignment), ""]


def areaTable(results):
    """Filtered shadows beside the light they stand for: the least error of each against both."""
    best = {}
    for result in results:
        if result.get("area_light") and result.get("error"):
            at = (result["scene"], result["technique"])
            if at not in best or result["error"]["rmse"] < best[at]["error"]["rmse"]:
                best[at] = result
    rows = [[scene, technique, f"{r['value']:g}", f"{r['error']['rmse']:.3f}", f"{r['area_light']['rmse']:.3f}",
             f"{r['area_light']['bias']:+.3f}"] for (scene, technique), r in best.items()]
    headings = ["scene", "technique", "taps or width", "against its filter", "against the area light", "bias there"]
    return tables.markdown(headings, rows, ["---", "---", "---:", "---:", "---:", "---:"]) if rows else ""


def quantityLines(results, quantity):
    lines = [f"### {quantity.title[0].upper()}{quantity.title[1:]}", ""]
    if quantity.without:
        lines += [f"Without an alternative: {quantity.without}.", ""]
    lines += [levelTable(results, quantity.name), "", *whyLines(results, quantity.name), "",
              f"What is left where more work does not help: {quantity.floor}.", "", *slopeLines(results, quantity.name)]
    if quantity.name == "area" and (compared := areaTable(results)):
        lines += ["What chapters 04 to 07 filter is not this light. At their best settings, against both:", "", compared, ""]
    return lines


def page(results):
    good = [result for result in results if result.get("error")]
    lines, figures = [INTRODUCTION.strip(), "", glance(good), "", EXPLANATION.strip(), ""], []
    for quantity in techniques.QUANTITIES:
        scenes = scenesOf(good, quantity.name)
        if not scenes:
            continue
        lines += quantityLines(good, quantity)
        for scene in scenes:
            figures.append(figure(estimates.curvesOf(good, scene, quantity.name), scene, quantity.name))
            if figures[-1].inDocs:
                lines += [figures[-1].markdown(), ""]
    return lines, figures


INTRODUCTION = """
## Which technique is cheapest, and why

At a glance: how often a technique is the cheapest of those that estimate the same, over scenes and errors from 0.1 to 0.003,
and how many times quicker it is then (medians) than the next one, and than the rays that a reader would otherwise cast.
"""
EXPLANATION = """
A technique is a curve: each setting of its quality is a point with a time and an error, and between two settings the curve
is interpolated on logarithmic axes. It reaches an error where all finer settings keep it: one that is better by luck does
not count. Techniques are compared where they estimate the same quantity. *Error* is the root mean square over all pixels
whose exact answer is defined; where the exact answer is itself many rays, its own noise is taken off, and errors that noise
would drown are not compared. *Bias* is the mean error: above 0 the picture is too bright. *ms* is the time of a frame in
which the light moves, so that maps are rendered again; what is baked once for a scene (chapters 09 and 11 at vertices) is
counted in full.
"""
