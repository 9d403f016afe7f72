"""out/benchmark.html: all plots and figures in one file that points nowhere else."""
import html
import json

import build

SHOWN = ("section", "scene", "quantity", "technique", "axis", "value", "wall_ms", "cpu_ms", "once_ms", "memory_mb")


def row(result):
    """What the table of the page shows of a point."""
    error = result["error"] or {}
    area = result["area_light"] or {}
    return {**{key: result.get(key) for key in SHOWN}, "rmse": error.get("rmse"), "max_abs": error.get("max_abs"),
            "bias": error.get("bias"), "area_rmse": area.get("rmse"), "work": result["work"],
            "command": " ".join(["./run", result["chapter"][:2], "--headless", "--scene", result["scene"],
                                 *result["flags"]])}


def page(machine, results, figures, drawn):
    """`drawn`: {figure's name: SVG}."""
    plots = "\n".join(f'<figure data-scene="{html.escape(figure.scene)}" data-quantity="{html.escape(figure.quantity)}">'
                      f"{drawn[figure.name]}</figure>" for figure in figures)
    about = (f"{machine['processor']}, {machine['cores']} cores; {machine['renderer']}; {machine['date']}; commit "
             f"{machine['commit']}")
    text = (build.ROOT / "tools" / "bench" / "browse.html").read_text()
    for name, value in (("ABOUT", html.escape(about)), ("PLOTS", plots),
                        ("DATA", json.dumps([row(result) for result in results]).replace("</", "<\\/"))):
        text = text.replace(f"%{name}%", value)
    return text
