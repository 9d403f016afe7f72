"""out/test/index.html: every image comparison of a run, what failed first, with pictures and worst pixels."""
import html
import json
import shutil

import build
import files

FOLDER = build.ROOT / "out" / "test"
HEAD = """<!DOCTYPE html>
<html lang="en"><meta charset="utf-8"><title>Penumbra: image tests</title>
<style>
  :root { color-scheme: light dark; }
  body { font: 15px/1.45 system-ui, sans-serif; margin: 1.5rem auto; max-width: 80rem; padding: 0 1rem; }
  table { border-collapse: collapse; margin: .5rem 0; } td, th { border-bottom: 1px solid #8884; padding: .2rem .6rem; text-align: left; }
  .pictures { display: flex; gap: .8rem; flex-wrap: wrap; } figure { margin: 0; flex: 1 1 18rem; max-width: 32rem; }
  figure img { width: 100%; image-rendering: pixelated; } .broken { color: #c33; font-weight: bold; }
</style>
"""


def clear():
    shutil.rmtree(FOLDER, ignore_errors=True)


def records():
    found = []
    for path in sorted(FOLDER.rglob("record.json")):
        record = json.loads(path.read_text())
        record["folder"] = path.parent.relative_to(FOLDER).as_posix()
        found.append(record)
    return found


def figure(value):
    """A NaN is null in a record."""
    return "NaN" if value is None else f"{value:.6g}"


def boundsOf(record):
    parts = []
    for bound in record.get("bounds", []):
        text = f"{bound['name']} {figure(bound['measured'])} of {figure(bound['bound'])}"
        parts.append(text if bound["kept"] else f"<span class=broken>{text}</span>")
    return html.escape(record["problem"]) if "problem" in record else ", ".join(parts)


def failureOf(record):
    pictures = "".join(f"<figure><img src=\"{html.escape(record['folder'])}/{file}.png\" alt=\"{name}\">"
                       f"<figcaption>{name}</figcaption></figure>"
                       for file, name in (("actual", "actual"), ("exact", "exact"), ("error", "error x10"))
                       if (FOLDER / record["folder"] / f"{file}.png").exists())
    worst = "".join(f"<tr><td>{w['x']}, {w['y']}</td><td>{figure(w['actual'])}</td><td>{figure(w['exact'])}</td></tr>"
                    for w in record.get("worst", []))
    table = f"<table><tr><th>worst pixels (x, y down)</th><th>actual</th><th>exact</th></tr>{worst}</table>" if worst else ""
    return (f"<h3 id=\"{html.escape(record['name'])}\">{html.escape(record['name'])}</h3>"
            f"<p>{html.escape(record['test'])}: {boundsOf(record)}</p><div class=pictures>{pictures}</div>{table}")


def write():
    """Nothing was compared: nothing is written."""
    made = records()
    if not made:
        return
    failed = [record for record in made if not record["passed"]]
    rows = "".join(f"<tr><td>{html.escape(r['name'])}</td><td>{'yes' if r['passed'] else '<span class=broken>no</span>'}</td>"
                   f"<td>{r.get('pixels', '')}</td><td>{r.get('excluded', '')}</td><td>{boundsOf(r)}</td></tr>" for r in made)
    page = (f"{HEAD}<h1>{len(made)} comparisons with exact answers, {len(failed)} failed</h1>"
            + "".join(failureOf(record) for record in failed)
            + "<h2>All comparisons</h2><table><tr><th>comparison</th><th>passed</th><th>pixels</th><th>left out</th>"
            f"<th>measured, of what is allowed</th></tr>{rows}</table></html>\n")
    files.write(FOLDER / "index.html", page)
    print(f"{len(made)} image comparisons: {FOLDER / 'index.html'}")
