"""Tables of figures in pages: their description, their text, and whether two texts show the same figures."""
import itertools
import re
from dataclasses import dataclass, field

from markers import PageError

COLUMN = re.compile(r"^column\s+(.+?)\s*=\s*(\S+)(?:\s*\*\s*([-+.\deE]+))?(\s+relative)?(?:\s+(\S+))?$")
ROW = re.compile(r"^row\s*(?:\{\s*(\w+)\s*=\s*([^}]*)\})?\s*(.*?)\s*\|\s*(.*)$")
RELATIVE_TOLERANCE = 0.02


@dataclass
class Column:
    heading: str
    path: str
    scale: float
    relative: bool
    format: str

    def compared(self, command):
        return self.path.split(".")[0] != "time" and not command.split()[0].endswith("_bench")


@dataclass
class Table:
    name: str
    columns: list = field(default_factory=list)
    rows: list = field(default_factory=list)  # (label, command line)

    def compared(self):
        """Is anything in it the same in every run?"""
        return any(column.compared(command) for column in self.columns for _, command in self.rows)


def parse(argument, where):
    first, *lines = argument.split("\n")
    if COLUMN.match(first.strip()):  # a table without a name begins with its columns
        first, lines = "", [first, *lines]
    table = Table(first.strip())
    for line in (line.strip() for line in lines):
        if not line:
            continue
        if column := COLUMN.match(line):
            heading, path, scale, relative, shown = column.groups()
            table.columns.append(Column(heading, path, float(scale or 1.0), bool(relative), shown or ""))
        elif row := ROW.match(line):
            key, values, label, command = row.groups()
            for value in (v.strip() for v in (values or "").split(",")):
                fill = (lambda text: text.replace("{" + key + "}", value)) if key else (lambda text: text)  # noqa: B023
                table.rows.append((fill(label), fill(command)))
        else:
            raise PageError(f"{where}: a line of a table begins with `column HEADING = PATH` or `row LABEL | COMMAND`, "
                            f"not `{line}`")
    if not table.columns or not table.rows:
        raise PageError(f"{where}: a table needs columns and rows")
    return table


def lookUp(report, path, where):
    value = report
    for step in path.split("."):
        try:
            value = value[int(step)] if isinstance(value, list) else value[step]
        except (KeyError, IndexError, ValueError, TypeError):
            has = ", ".join(value) if isinstance(value, dict) else type(value).__name__
            raise PageError(f"{where}: the report has no {path}; at `{step}` there is: {has}") from None
    return value


def show(value, column, first):
    if value is None:
        return "–"
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, str):
        return value
    number = value * column.scale
    if column.relative:
        number = number / (first * column.scale) if first else float("nan")
    return format(round(number) if column.format.endswith("d") else number, column.format)


def cells(table, reportOf, where):
    """Rows of texts; `reportOf(command)` gives a report."""
    reports = [reportOf(command) for _, command in table.rows]
    shown = []
    for (label, _), report in zip(table.rows, reports):
        row = []
        for column in table.columns:
            if column.path == "label":
                row.append(label)
                continue
            first = lookUp(reports[0], column.path, where) if column.relative else None
            row.append(show(lookUp(report, column.path, where), column, first))
        shown.append(row)
    return shown


def markdown(headings, rows, alignment=None):
    escape = lambda text: str(text).replace("|", "\\|").replace("\n", " ")  # noqa: E731
    alignment = alignment or ["---"] * len(headings)
    lines = [headings, alignment, *rows]
    return "\n".join("| " + " | ".join(escape(cell) for cell in line) + " |" for line in lines)


def fromMarkdown(body):
    """Rows of cells below the headings, as shown in a page."""
    lines = [line.strip() for line in body.strip().splitlines() if line.strip().startswith("|")]
    split = [[cell.strip().replace("\\|", "|") for cell in re.split(r"(?<!\\)\|", line)[1:-1]] for line in lines]
    return split[2:]


def alignments(table):
    return ["---" if column.path == "label" else "---:" for column in table.columns]


def sameFigure(old, new):
    """Equal text, or numbers within 2 % or one step of the last digit shown."""
    if old == new:
        return True
    try:
        a, b = float(old), float(new)
    except ValueError:
        return False
    mantissa, _, exponent = new.lower().partition("e")
    step = 10.0 ** (int(exponent or 0) - len(mantissa.partition(".")[2]))
    return abs(a - b) <= max(RELATIVE_TOLERANCE * max(abs(a), abs(b)), 1.001 * step)


def differences(table, old, new):
    """What a reader would notice between two sets of cells; times are not compared."""
    if len(old) != len(new) or any(len(a) != len(b) for a, b in zip(old, new)):
        return ["other rows or columns"]
    found = []
    for (label, command), a, b in zip(table.rows, old, new):
        for column, x, y in zip(table.columns, a, b):
            if (column.compared(command) and not sameFigure(x, y)) or (not x):
                found.append(f"{label}, {column.heading}: the page says {x or 'nothing'}, the program {y}")
    return found


def cellOf(table, rows, label, heading, where):
    labels = [row[0] for row in table.rows]
    headings = [column.heading for column in table.columns]
    if label not in labels or heading not in headings:
        raise PageError(f"{where}: table {table.name} has rows {', '.join(labels)} and columns {', '.join(headings)}")
    if len(rows) != len(labels):
        raise PageError(f"{where}: table {table.name} is stale: run docs/refresh")
    return rows[labels.index(label)][headings.index(heading)]


def uniqueNames(tables, where):
    for a, b in itertools.combinations([table.name for table in tables if table.name], 2):
        if a == b:
            raise PageError(f"{where}: two tables of this page are called {a}")
