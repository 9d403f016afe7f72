"""What a run leaves in out/bench and out: the results as CSV and JSON, the plots, and the page to browse them."""
import csv
import io
import json

import build
from files import write as put
from bench import browse, raster, svg

COLUMNS = ("section", "scene", "quantity", "technique", "chapter", "axis", "value", "wall_ms", "wall_min_ms", "cpu_ms",
           "cpu_min_ms", "once_ms", "setup_ms", "memory_mb", "memory_with_truth", "passes", "runs")
FIGURES = ("against", "truth", "pixels", "rmse", "mean_abs", "max_abs", "bias", "standard_error")


def folder():
    return build.ROOT / "out" / "bench"


def csvOf(results):
    work = sorted({counter for result in results for counter in result["work"]})
    headings = [*COLUMNS, *FIGURES, *(f"area_light_{figure}" for figure in ("rmse", "max_abs", "bias")),
                *(f"work_{counter}" for counter in work), "flags"]
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow(headings)
    for result in results:
        error, area = result["error"] or {}, result["area_light"] or {}
        writer.writerow([*(result.get(column, "") for column in COLUMNS), *(error.get(figure, "") for figure in FIGURES),
                         *(area.get(figure, "") for figure in ("rmse", "max_abs", "bias")),
                         *(result["work"].get(counter, "") for counter in work), " ".join(result["flags"])])
    return out.getvalue()


def jsonOf(machine, results):
    """A line for each point, so that what changed can be read in a diff."""
    lines = ",\n".join(json.dumps(result, ensure_ascii=False, separators=(",", ":")) for result in results)
    return f'{{"schema":1,\n"machine":{json.dumps(machine, ensure_ascii=False)},\n"results":[\n{lines}\n]}}\n'


def write(machine, results, page, figures):
    """Everything but docs/: returns the path of the page to browse."""
    put(folder() / "results.csv", csvOf(results))
    put(folder() / "results.json", jsonOf(machine, results))
    put(folder() / "benchmark.md", page)
    drawn = {figure.name: svg.render(figure) for figure in figures}
    for figure in figures:
        # A picture takes longer than its text: only what changed is painted.
        file = folder() / f"{figure.name}.svg"
        if not file.is_file() or file.read_text() != drawn[figure.name] or not file.with_suffix(".png").is_file():
            raster.render(figure, file.with_suffix(".png"))
            put(file, drawn[figure.name])
    path = build.ROOT / "out" / "benchmark.html"
    put(path, browse.page(machine, results, figures, drawn))
    return path
