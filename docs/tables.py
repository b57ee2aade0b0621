"""The tables of the reports in docs/studies, by name, made from the tables of docs/data (docs/quoted_numbers.py writes them into the pages),
and the numbers that only one report quotes."""

import functools
import math
import statistics

from quoted_numbers import SHORT, correlation, number, rows_of, summary

POURED = ("default: 6 sqrt(g D), rate 0.25, h = 1 ms", "pour-6")
PREPARATIONS = [POURED, ("2 sqrt(g D)", "pour-2"), ("10 sqrt(g D)", "pour-10"), ("rate 1", "fast-pour"), ("rate 0.05", "slow-pour"),
                ("friction 0.3 while pouring", "low-friction"), ("geometric", "geometric"), ("collapse", "all-at-once")]
LENGTHS = [("50 D", "length-50"), ("100 D", "pour-6"), ("200 D", "paper-pbc"), ("400 D", "length-400")]
STEPS = [("5 ms", "step-5ms"), ("1 ms", "pour-6"), ("0.25 ms", "step-250us")]
RATES = [("0.5 deg/s", "rate-half"), ("2 deg/s", "rate-2")]
WALL_LENGTHS = (100, 150, 200, 250, 300)
#: The paper's k_L - k_0.
PAPER_K = 2.5


def with_error(values, digits, scale=1.0):
    """Mean ± standard error; a dash without values."""
    if not values:
        return "–"
    found = summary(value * scale for value in values)
    mean = f"{found['mean']:.{digits}f}"
    mean = mean if float(mean) else mean.lstrip("-")
    return f"{mean} ± {found['error']:.{digits}f}" if found["n"] > 1 else mean


def signed(cell):
    return cell if cell.startswith(("-", "–")) else f"+{cell}"


def markdown(head, rows, text_columns=1):
    """A table: the first columns are aligned left, all others right."""
    rule = ["---"] * text_columns + ["--:"] * (len(head) - text_columns)
    return "\n".join(f"| {' | '.join(cells)} |" if cells is not rule else f"|{'|'.join(cells)}|" for cells in [head, rule, *rows])


def of_groups(beds, groups, title, columns):
    """A table with a row for each group of beds. Columns: head, quantity, digits, scale."""
    rows = []
    for label, group in groups:
        if group not in beds.groups:
            raise KeyError(f"docs/data/beds.csv has no beds {group}")
        rows.append([label, str(len(beds.groups[group])),
                     *(with_error(beds.values(group, quantity).values(), digits, *scale) for _, quantity, digits, *scale in columns)])
    return markdown([title, "beds", *(column[0] for column in columns)], rows)


ANGLES = [("theta_c, deg", "theta_c", 2), ("first slide, deg", "first_slide", 2)]
FLAT = [("solid fraction", "phi@0", 4), ("z", "z@0", 3), ("Gamma", "Gamma@0", 3)]
OVERLOAD = [("p_o at 0 deg", "p_o@0", 3), ("p_o at 15 deg", "p_o@15", 3), ("p_o before failure", "p_o@before", 3)]
LENGTH = [("mean l_c at 0 deg, D", "lc_mean@0", 2), ("mean l_c at 15 deg, D", "lc_mean@15", 1)]
TRANSITION = [("l_c jumps, deg", "lc_jump", 1), ("clusters span, deg", "percolation", 1)]


def preparation_flat(beds):
    return of_groups(beds, PREPARATIONS, "bed", FLAT)


def preparation_slope(beds):
    return of_groups(beds, PREPARATIONS, "bed", ANGLES + OVERLOAD + TRANSITION)


def preparation_manual(beds):
    return of_groups(beds, PREPARATIONS, "bed", FLAT + ANGLES[:1] + [("p_o at 0 deg", "p_o@0", 2)])


def directions(beds):
    rows = {row["beds"]: row for row in rows_of("directions.csv")}
    bins = [column for column in next(iter(rows.values())) if column != "beds"]
    return markdown(["bed", *bins], [[label, *(f"{number(rows[group][each]):.2f}" for each in bins)] for label, group in PREPARATIONS])


def finite_size(beds):
    return of_groups(beds, LENGTHS, "L", ANGLES + OVERLOAD + TRANSITION)


def time_steps(beds):
    return of_groups(beds, STEPS, "time step", FLAT + ANGLES + OVERLOAD[1:2] + TRANSITION)


def rate_changes(beds, group, quantity):
    """The values of a quantity less those at 1 deg/s of the same beds."""
    values, others = (beds.values(each, quantity) for each in (group, "pour-6"))
    return [values[seed] - others[seed] for seed in values.keys() & others.keys()]


def rates(beds):
    columns = [("theta_c", "theta_c, deg", 2), ("first_slide", "first slide, deg", 2), ("p_o@15", "p_o at 15 deg", 3), ("lc_jump", "l_c jumps, deg", 1),
               ("percolation", "clusters span, deg", 1)]
    rows = [["**1 deg/s**, values", str(len(beds.groups["pour-6"])), *(with_error(beds.values("pour-6", name).values(), digits) for name, _, digits in columns)]]
    rows += [[label, str(len(beds.groups[group])), *(signed(with_error(rate_changes(beds, group, name), digits)) for name, _, digits in columns)]
             for label, group in RATES]
    return markdown(["rate", "beds", *(head for _, head, _ in columns)], rows)


def rate_numbers(beds):
    """GROUP.QUANTITY, the mean difference to the same beds at 1 deg/s with its error; .rms, its root mean square."""
    found = {}
    for group, quantity in ((group, quantity) for _, group in RATES for quantity in ("theta_c", "first_slide", "p_o@15")):
        each = rate_changes(beds, group, quantity)
        found |= {f"{group}.{quantity}": (summary(each)["mean"], summary(each)["error"]), f"{group}.{quantity}.rms": rms(each)}
    return found


#: What the paper gives, the quantity, its unit's digits and factor.
FIFTY = [("theta_c, deg", "19 to 21, all beds", "theta_c", 2), ("first slide, deg", "", "first_slide", 2),
         ("theta_d by the jump of l_c max, deg", "15", "lc_jump", 2), ("theta_d by percolation, deg", "15", "percolation", 2),
         ("theta_d by dilation, least volume, deg", "15", "dilation", 2), ("theta_c less theta_d by the jump, deg", "", "theta_c-lc_jump", 2),
         ("theta_c less theta_d by percolation, deg", "", "theta_c-percolation", 2), ("solid fraction", "about 0.8", "phi@0", 4),
         ("z at 0 deg", "about 3.5", "z@0", 3), ("Gamma at 0 deg", "about 0.08", "Gamma@0", 3), ("p_o at 0 deg", "0.30", "p_o@0", 3),
         ("p_o at 15 deg", "0.45", "p_o@15", 3), ("p_o when clusters percolate", "0.45", "p_o@percolation", 3),
         ("p_o after the jump of l_c max", "0.45", "p_o@lc_jump", 3), ("p_o 0.25 deg before theta_c", "0.60", "p_o@before", 3),
         ("mean l_c at 0 deg, D", "4", "lc_mean@0", 2), ("mean l_c at 15 deg, D", "5", "lc_mean@15", 2),
         ("mean l_c 0.25 deg before theta_c, D", "7", "lc_mean@before", 1), ("largest l_c at 0 deg, D", "5", "lc_max@0", 1),
         ("largest l_c at 15 deg, D", "15, then 30", "lc_max@15", 1), ("volume strain at 10 deg, 1e-3", "negative", "volume_strain@10", 3, 1e3),
         ("volume strain at 15 deg, 1e-3", "least", "volume_strain@15", 3, 1e3),
         ("volume strain 0.25 deg before theta_c, 1e-3", "positive", "volume_strain@before", 2, 1e3)]


def fifty(beds, *quantities):
    """The paper's values and those of fifty beds: of some quantities, or of all."""
    rows = []
    for name, paper, quantity, digits, *scale in (row for row in FIFTY if not quantities or row[2] in quantities):
        values = [value * (scale[0] if scale else 1.0) for value in beds.values("paper-pbc", quantity).values()]
        rows.append([name, paper, str(len(values)), with_error(values, digits), f"{statistics.stdev(values):.{digits}f}"])
    return markdown(["quantity", "paper", "beds", "mean", "deviation"], rows)


def readings(beds):
    single = rows_of("readings.csv")
    seeds = {int(row["seed"]) for row in single}
    rows = []
    for name, paper, column, digits in (("p_o at 0 deg", "0.30", "p_o@0", 3), ("p_o at 15 deg", "0.45", "p_o@15", 3),
                                        ("p_o 0.25 deg before theta_c", "0.60", "p_o@before", 3), ("mean l_c at 0 deg, D", "4", "lc_mean@0", 2),
                                        ("mean l_c at 15 deg, D", "5", "lc_mean@15", 2), ("mean l_c 0.25 deg before theta_c, D", "7", "lc_mean@before", 1),
                                        ("largest l_c at 0 deg, D", "5", "lc_max@0", 1), ("theta_d by the jump of l_c max, deg", "15", "lc_jump", 1),
                                        ("theta_d by percolation, deg", "15", "percolation", 1)):
        cells = [name, paper]
        for reading in ("grain", "grain, 2 Gamma_c"):
            values = [number(text) for row in single if row["reading"] == reading for key, text in row.items() if key.split(" (")[0] == column]
            known = [value for value in values if not math.isnan(value)]
            cells.append(with_error(known, digits) + (f" ({len(known)} of {len(values)})" if 0 < len(known) < len(values) else ""))
        cells.append(with_error([value for seed, value in beds.values("paper-pbc", column).items() if seed in seeds], digits))
        rows.append(cells)
    return markdown(["quantity", "paper", "grain, Gamma_c", "grain, 2 Gamma_c", "with first neighbours, Gamma_c"], rows)


def reading_numbers(_):
    """Means over the beds of readings.csv: grain.p_o@0, grain-2.lc_mean@15, ..."""
    found = {}
    for row in rows_of("readings.csv"):
        for column, text in row.items():
            if column not in ("reading", "seed"):
                key = f"{'grain' if row['reading'] == 'grain' else 'grain-2'}.{column.split(' (')[0]}"
                found.setdefault(key, []).append(number(text))
    return {key: statistics.mean(value for value in values if not math.isnan(value)) if not all(map(math.isnan, values)) else math.nan
            for key, values in found.items()}


# ---- Rolling friction.

#: Coefficients of friction, and for each those of rolling friction with their beds (docs/quoted_numbers.py).
ROLLING = {0.2: {mu_r: f"rolling-{100 * mu_r:g}-mu-low" for mu_r in (0, 0.05, 0.5)},
           0.5: {mu_r: f"rolling-{100 * mu_r:g}" for mu_r in (0, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5)},
           1.0: {mu_r: f"rolling-{100 * mu_r:g}-mu-high" for mu_r in (0, 0.05, 0.5)}}


def rolling(beds):
    return of_groups(beds, [(f"{mu_r:g}", SHORT[group]) for mu_r, group in ROLLING[0.5].items()], "mu_r", FLAT + ANGLES + OVERLOAD)


def rolling_friction(beds):
    rows = []
    for mu, groups in ROLLING.items():
        rows.append([f"{mu:g}", *(with_error(beds.values(SHORT[groups[mu_r]], "theta_c").values(), 1) for mu_r in ROLLING[1.0])])
    return markdown(["mu", *(f"theta_c with mu_r = {mu_r:g}, deg" for mu_r in ROLLING[1.0])], rows)


# ---- Walls.


#: Beds between walls with friction and without, and geometric ones between walls with friction: the beginning of the names of their groups.
WALLS = {"rough": "paper-wbc", "smooth": "smooth-walls", "geometric": "geometric-walls"}
#: Readings of (sigma_T / sigma_N) / tan(theta) between walls: the column of beds.csv, the name.
WALL_READINGS = {"failure_ratio": "before failure", "wall_ratio_from_offset": "before failure, less 0 deg", "wall_slope": "slope"}


def walls(beds, which):
    columns = [("theta_c, deg", "theta_c", 2), ("first slide, deg", "first_slide", 2), ("sigma_T/sigma_N at 0 deg", "wall_offset", 3),
               *((name, reading, 3) for reading, name in WALL_READINGS.items())]
    groups = {f"{length} D": f"{WALLS[which]}-{length}" for length in WALL_LENGTHS}
    return of_groups(beds, [(label, group) for label, group in groups.items() if group in beds.groups], "L", columns)


def wall_points(beds, which, reading):
    """H / L, with H = V / L, and the ratio of each bed between walls, by length; of lengths that have been computed."""
    groups = {length: beds.groups.get(f"{WALLS[which]}-{length}", []) for length in WALL_LENGTHS}
    points = {length: [(bed["wall_height"] / length, bed[reading]) for bed in group] for length, group in groups.items()}
    return {length: each for length, each in points.items() if each and not math.isnan(each[0][0])}


def wall_fit(points):
    """k_L - k_0 of the law 1 - (k_L - k_0) / 3 H / L (the paper's Eq. 15), by least squares, and its standard error."""
    square = sum(x * x for x, _ in points)
    k = 3 * sum(x * (1 - ratio) for x, ratio in points) / square
    return k, 3 * math.sqrt(sum((ratio - 1 + k / 3 * x) ** 2 for x, ratio in points) / (len(points) - 1) / square)


def wall_coefficients(beds):
    rows = []
    for which in WALLS:
        for reading, name in WALL_READINGS.items():
            points = wall_points(beds, which, reading)
            fits = [each and wall_fit(each) for each in [*map(points.get, WALL_LENGTHS), sum(points.values(), [])]]
            rows.append([which, name, *(f"{fit[0]:.2f} ± {fit[1]:.2f}" if fit else "–" for fit in fits)])
    return markdown(["walls", "reading", *(f"{length} D" for length in WALL_LENGTHS), "all beds"], rows, text_columns=2)


def wall_numbers(beds):
    """k_L - k_0 of all beds by the kind of walls and the reading, rough.wall_slope, with its error; .LENGTH, that of one length; and height,
    the mean height of the beds."""
    found = {}
    for which, reading in ((which, reading) for which in WALLS for reading in WALL_READINGS):
        points = wall_points(beds, which, reading)
        found |= {f"{which}.{reading}": wall_fit(sum(points.values(), []))} if points else {}
        found |= {f"{which}.{reading}.{length}": wall_fit(each) for length, each in points.items()}
    found["height"] = statistics.mean(length * x for which in WALLS for length, each in wall_points(beds, which, "wall_slope").items() for x, _ in each)
    return found


# ---- Metastability.

CLASSES = [(0, 0.5), (0.5, 1), (1, 2), (2, 3), (3, 4), (4, 6), (6, math.inf)]
#: Smallest and largest push, sqrt(g D).
PUSHES = (0.05, 5.0)


@functools.cache
def states():
    """States of docs/data/metastability.csv: seed, tilts, whether the bed holds, and the bracket of the threshold."""
    return [{key: number(value) if value != "NaN" else math.nan for key, value in row.items()} for row in rows_of("metastability.csv")]


def threshold(state):
    """The logarithmic middle of the bracket of the push that starts an avalanche, sqrt(g D): the smallest push if the bed does not hold or
    needs less, infinite above the largest."""
    return math.inf if math.isnan(state["v_with"]) else math.sqrt(max(state["v_without"], PUSHES[0]) * max(state["v_with"], PUSHES[0]))


def bracketed(state):
    """Whether the threshold lies between the smallest and the largest push."""
    return PUSHES[0] < threshold(state) < math.inf


def push_text(value):
    if value == PUSHES[0]:
        return f"< {PUSHES[0]:g}"
    return f"> {PUSHES[1]:g}" if math.isinf(value) else f"{value:.2f}"


def metastability(_):
    rows = []
    for low, high in CLASSES:
        here = [state for state in states() if low < state["distance"] <= high]
        found = [threshold(state) for state in here]
        brackets = [state for state in here if bracketed(state) or not state["monotone"]]
        rows.append([f"{low:g} to {high:g}" if high < math.inf else f"above {low:g}", str(len(here)), str(sum(not s["holds"] for s in here)),
                     str(sum(math.isinf(v) for v in found)), str(sum(not s["monotone"] for s in brackets)),
                     *(push_text(f(found)) if found else "–" for f in (min, statistics.median, max))])
    return markdown(["theta_c - theta, deg", "states", "do not hold", "no avalanche up to 5", "erratic", "least", "median", "largest"], rows)


def metastability_numbers(beds):
    """How the threshold ends at theta_c, and where pushes of up to 5 sqrt(g D) begin to start avalanches, compared with theta_d by the jump of
    l_c and with theta_r of the same beds (`dynamic-angle`)."""
    by_seed = {}
    for state in states():
        if state["distance"] > 0:
            by_seed.setdefault(int(state["seed"]), []).append(state)
    last = [min(each, key=lambda state: state["distance"]) for each in by_seed.values()]
    onset = {seed: max((state["theta"] for state in each if state["theta"] <= min(
        [s["theta"] for s in each if s["holds"] and threshold(s) < math.inf] or [math.inf])), default=math.nan) for seed, each in by_seed.items()}
    onset = {seed: theta for seed, theta in onset.items() if not math.isnan(theta)}
    found = {"beds": len(last), "last.fail": sum(not s["holds"] for s in last), "last.smallest": sum(s["holds"] and threshold(s) == PUSHES[0] for s in last),
             "last.others": sum(threshold(s) > PUSHES[0] for s in last), "nearest": min(s["distance"] for s in last), "farthest": max(s["distance"] for s in last)}
    brackets = [state for state in states() if bracketed(state)]
    found |= {"brackets": len(brackets), "erratic": sum(not s["monotone"] for s in states() if s["holds"])}
    theta_c = {int(state["seed"]): state["theta_c"] for state in states()}
    pairs = {"theta_c": theta_c, "lc_jump": beds.values("dynamic-angle", "lc_jump"), "theta_r": beds.values("dynamic-angle", "theta_r")}
    for name, angle in pairs.items():
        difference = summary(onset[seed] - angle[seed] for seed in onset if seed in angle)
        found |= {f"onset-{name}": (difference["mean"], difference["error"]), f"onset-{name}.errors": difference["mean"] / difference["error"]}
    return found | {"onset.min": min(onset.values()), "onset.max": max(onset.values())}


# ---- The dynamic angle.

DYNAMIC = [("theta_c", "theta_c"), ("theta_d, jump of l_c max, Gamma_c", "lc_jump"), ("theta_d, jump of l_c max, 2 Gamma_c", "lc_jump[1]"),
           ("theta_d, percolation, Gamma_c", "percolation"), ("theta_d, dilation, volume: least", "dilation"),
           ("upper end of its range", "dilation_high"), ("theta_d, dilation, centre of mass: least", "dilation[1]"),
           ("upper end of its range", "dilation_high[1]")]


def dynamic_angle(beds):
    rest = beds.values("dynamic-angle", "theta_r")
    rows = [["theta_r", str(len(rest)), with_error(rest.values(), 2), "", "", ""]]
    for name, quantity in DYNAMIC:
        angle = beds.values("dynamic-angle", quantity)
        difference = [angle[seed] - rest[seed] for seed in angle if seed in rest]
        found = summary(difference)
        rms = math.sqrt(statistics.mean(value * value for value in difference))
        rows.append([name, str(len(angle)), with_error(angle.values(), 1), f"{rms:.1f}", f"{correlation(angle, rest)[0]:+.2f}",
                     f"{found['mean'] / found['error']:+.1f}"])
    return markdown(["angle, deg", "beds", "mean", "rms of theta_r - angle", "correlation", "distance"], rows)


# ---- Rearrangements.


def events(beds):
    groups = [("poured, L = 50 D, H = 20 D", "demo:deposition.method=pour"), ("collapsed, L = 50 D, H = 20 D", "demo:deposition.method=collapse"),
              ("poured, L = 100 D, H = 40 D", "pour-6")]
    return of_groups(beds, groups, "beds", [("theta_c, deg", "theta_c", 1), ("events a bed", "events", 1), ("exponent of the energies", "events_exponent", 2),
                                            ("mean waiting angle, deg", "events_waiting", 2), ("share that dilates", "events_dilating", 2)])


def events_by_tilt(_):
    labels = {"demo:deposition.method=pour": "poured, L = 50 D", "demo:deposition.method=collapse": "collapsed, L = 50 D", "pour-6": "poured, L = 100 D"}
    found = rows_of("events.csv")
    ranges = list(dict.fromkeys((row["from (deg)"], row["to (deg)"]) for row in found))
    rows = []
    for group, label in labels.items():
        here = {(row["from (deg)"], row["to (deg)"]): row for row in found if row["beds"] == group}
        rows.append([label, *(f"{here[r]['dilating']} of {here[r]['events']}" for r in ranges)])
    return markdown(["events that dilate the bed", *(f"{low} to {high} deg" for low, high in ranges)], rows)


# ---- What announces failure.


def announcing(_, shown=20):
    rows = []
    for row in rows_of("precursor-ranking.csv")[:shown]:
        gain = number(row["gain"]) / number(row["gain_error"]) if number(row["gain_error"]) else math.nan
        changes = [number(row[f"contrast_{k}"]) for k in (1, 2, 3)]
        contrast = ", ".join("–" if math.isnan(change) else f"{change:+.1f}" for change in changes)
        rows.append([row["rank"], f"`{row['measure']}`", contrast, f"{number(row['error']):.2f} ± {number(row['error_error']):.2f}",
                     f"{number(row['with_tilt']):.2f} ± {number(row['with_tilt_error']):.2f}", "" if math.isnan(gain) else f"{gain:+.1f}"])
    return markdown(["rank", "measure", "change at 1, 2, 3 deg", "error, deg", "with the tilt, deg", "adds"], rows, text_columns=3)


def ranking_numbers(_):
    """Errors of the distance to failure, what each quantity adds to the tilt in standard errors, and changes over the deviation: error.NAME
    (with its standard error), adds.NAME, change.NAME.1, rank.NAME; own.error.NAME and own.adds.NAME at Gamma_c of each bed; most, the
    largest of all adds."""
    found = {}
    for prefix, table in (("", "precursor-ranking.csv"), ("own.", "precursor-ranking-own.csv")):
        for row in rows_of(table):
            name, values = row["measure"], {key: number(text) for key, text in row.items() if key != "measure"}
            found[f"{prefix}error.{name}"] = (values["error"], values["error_error"])
            found[f"{prefix}adds.{name}"] = values["gain"] / values["gain_error"] if values["gain_error"] else math.nan
            found[f"{prefix}rank.{name}"] = values["rank"]
            found |= {f"{prefix}change.{name}.{k}": values[f"contrast_{k}"] for k in (1, 2, 3)}
    adds = [value for key, value in found.items() if key.startswith("adds.") and not math.isnan(value)]
    return found | {"most": max(adds), "count": len([key for key in found if key.startswith("error.")]) - 1}


# ---- Cycles.


def cycles(_):
    found = rows_of("cycles.csv")
    rows = []
    for cycle in (1, 2, 3, 5, 10):
        cells = [str(cycle)]
        for place, column, digits, scale in (("end", "volume_strain (1)", 3, 100.0), ("top", "z (1)", 3, 1), ("end", "z (1)", 3, 1),
                                             ("top", "anisotropy (1)", 3, 1), ("top", "critical (1)", 3, 1), ("end", "critical (1)", 3, 1)):
            cells.append(with_error([number(r[column]) for r in found if int(r["cycle"]) == cycle and r["place"] == place], digits, scale))
        rows.append(cells)
    return markdown(["cycle", "volume strain at its end, %", "z at 12 deg", "z at 0 deg", "anisotropy at 12 deg", "nu at 12 deg", "nu at 0 deg"], rows, text_columns=0)


# ---- Admissible forces.


def forces(_):
    found = rows_of("forces.csv")
    letters = {("pour-6", "1"): "A", ("pour-6", "2"): "B", ("paper-pbc", "1"): "C", ("paper-pbc", "2"): "D"}
    rows = []
    for tilt in dict.fromkeys(row["tilt (deg)"] for row in found):
        for bed, letter in letters.items():
            here = {row["quantity"]: row for row in found if (row["beds"], row["seed"]) == bed and row["tilt (deg)"] == tilt}
            if not here:
                continue
            cells = [f"{float(tilt):g}", letter, here["p_o"]["count"]]
            for quantity, digits in (("p_o", 3), ("lc_mean", 2), ("lc_max", 1), ("Gamma", 3)):
                row = here[quantity]
                cells.append(f"{number(row['stored']):.{digits}f}")
                none = not float(row["count"])
                cells.append("none" if none else f"{number(row['mean']):.{digits}f} ± {number(row['deviation']):.{digits}f} "
                             f"({number(row['least']):.{digits}f} to {number(row['largest']):.{digits}f})")
            rows.append(cells)
    heads = [f"{name} {which}" for name in ("p_o", "mean l_c", "largest l_c", "Gamma") for which in ("stored", "others")]
    return markdown(["deg", "bed", "n", *heads], rows)


def force_numbers(_):
    """Of a quantity over other admissible forces, with .min, .mean and .max over the beds: p_o@0, its standard deviation;
    p_o@0.relative, the same over the mean; p_o@0.excess, the stored value less the mean; p_o@0.farthest, the largest relative difference
    from the stored value; p_o@0.above, the largest value over sin(tilt), less 1."""
    found = {}
    for row in rows_of("forces.csv"):
        if not row["deviation"]:
            continue
        tilt = number(row["tilt (deg)"])
        stored, mean, deviation, least, largest = (number(row[key]) for key in ("stored", "mean", "deviation", "least", "largest"))
        sine = math.sin(math.radians(tilt))
        for measure, value in (("", deviation), (".relative", deviation / mean), (".excess", stored - mean),
                               (".farthest", max(stored - least, largest - stored) / stored), (".above", largest / sine - 1 if sine else math.nan)):
            found.setdefault(f"{row['quantity']}@{tilt:g}{measure}", []).append(value)
    return {f"{key}.{name}": f(values) for key, values in found.items() for name, f in (("min", min), ("mean", statistics.mean), ("max", max))}


# ---- Talus and LAMMPS.

#: Quantities of two-codes-states.csv: their names in the tables, and digits.
OF_TWO_CODES = {"Gamma": ("Gamma", 4), "sigma_t/sigma_n": ("sigma_T/sigma_N", 4), "sigma_xx/sigma_yy": ("sigma_xx/sigma_yy", 3),
                "p_o": ("p_o", 3), "z": ("z", 3), "phi": ("solid fraction", 4), "a_c": ("a_c, contacts", 3),
                "a_n": ("a_n, normal forces", 3), "a_t": ("a_t, tangential forces", 3), "sliding": ("sliding contacts", 3),
                "mobilised": ("mean mobilised friction", 3), "weak": ("forces below a tenth of the mean", 3),
                "displacement": ("mean displacement, D", 4)}
#: The code with which another is compared, if not with `talus`.
REFERENCES = {"lammps-rolling": "rolling", "lammps-positions": "positions", "fine": "positions"}


@functools.cache
def two_codes_values():
    """Values by code, quantity, with @T that of a tilt of T deg, and seed: lammps-1e5, Gamma@10, 3."""
    found = {}
    for name in ("two-codes-beds.csv", "two-codes-states.csv"):
        for row in rows_of(name):
            tilt = f"@{row['tilt (deg)']}" if "tilt (deg)" in row else ""
            for quantity in row.keys() - {"seed", "code", "version", "tilt (deg)"}:
                if not math.isnan(value := number(row[quantity])):
                    found.setdefault(row["code"], {}).setdefault(quantity.removesuffix(" (deg)") + tilt, {})[int(row["seed"])] = value
    return found


def both_codes(code, quantity, reference=None):
    """The values of Talus, or of another code, and of a code for the beds that both have computed: two lists."""
    reference, other = (two_codes_values().get(each, {}).get(quantity, {}) for each in (reference or REFERENCES.get(code, "talus"), code))
    seeds = sorted(reference.keys() & other.keys())
    return [reference[seed] for seed in seeds], [other[seed] for seed in seeds]


def differences(code, quantity, reference=None):
    """The values of a code less those of Talus, or of another code, bed by bed."""
    return [other - own for own, other in zip(*both_codes(code, quantity, reference), strict=True)]


def two_codes(_, tilt):
    """The state of the beds at a tilt by Talus and by LAMMPS."""
    rows = []
    for quantity, (title, digits) in OF_TWO_CODES.items():
        own, soft = both_codes("lammps-1e5", f"{quantity}@{tilt}")
        rows.append([title, with_error(own, digits), with_error(soft, digits),
                     *(with_error(differences(code, f"{quantity}@{tilt}"), digits) for code in ("lammps-1e5", "lammps-1e6", "again"))])
    for name, title in (("common", "share of Talus's contacts"), ("correlation", "correlation of their f_n with Talus's")):
        each = (both_codes(code, f"{name}@{tilt}")[1] for code in ("lammps-1e5", "lammps-1e6", "again"))
        rows.append([title, "", "", *(with_error(values, 3) for values in each)])
    return markdown([f"at {tilt} deg", "Talus", "LAMMPS, 1e5", "LAMMPS, 1e5, less Talus", "LAMMPS, 1e6, less Talus", "Talus again, less Talus"], rows)


def two_codes_angles(_):
    """Angles of failure of the same beds by Talus and by a second computation."""
    rows = []
    for code, title in (("lammps-1e5", "LAMMPS, 1e5"), ("lammps-1e6", "LAMMPS, 1e6"), ("again", "Talus again"), ("positions", "Talus, positions alone"),
                        ("lammps-positions", "LAMMPS, positions alone, against Talus from them"),
                        ("fine", "Talus, positions alone, steps of 0.1 ms, against those of 1 ms"), ("rolling", "Talus, mu_r = 0.05"),
                        ("lammps-rolling", "LAMMPS, mu_r = 0.05, against Talus with it")):
        own, other = both_codes(code, "theta_c")
        if own:
            each = differences(code, "theta_c")
            rows.append([title, str(len(own)), *(with_error(values, 2) for values in (own, other, each)), f"{rms(each):.2f}"])
    return markdown(["second computation", "beds", "theta_c by Talus, deg", "its theta_c, deg", "difference, deg", "rms, deg"], rows)


def two_codes_limits(_):
    """What stiffer springs and shorter steps change."""
    pairs = {"LAMMPS, 1e5, less Talus": ("lammps-1e5",), "LAMMPS, 1e6, less 1e5": ("lammps-1e6", "lammps-1e5"),
             "Talus, 0.1 ms, less 1 ms": ("fine",)}

    def changes(name, quantity, digits):
        each = {title: differences(code, quantity, *reference) for title, (code, *reference) in pairs.items()}
        return [name, *(with_error(values, digits) for values in each.values())]

    rows = [changes("theta_c, deg", "theta_c", 2)]
    for quantity, tilts in (("z", (0, 5, 10, 15)), ("displacement", (5, 10, 15)), ("sigma_xx/sigma_yy", (0, 10)), ("a_t", (10,))):
        title, digits = OF_TWO_CODES[quantity]
        title, comma, unit = title.partition(",") if quantity == "displacement" else (title, "", "")
        rows += [changes(f"{title} at {tilt} deg{comma}{unit}", f"{quantity}@{tilt}", digits) for tilt in tilts]
    return markdown(["quantity", *pairs], rows)


def two_codes_memory(_):
    """The beds that were also computed from the positions alone: their values with the forces, and what changes without, by both codes."""
    codes = {"Talus": ("positions", "talus"), "LAMMPS": ("lammps-positions", "lammps-1e5")}
    heads = [f"{name}, {len(both_codes(without, 'z@0', forces)[0])} beds" for name, (without, forces) in codes.items()]
    rows = []
    for tilt in (0, 10, 15):
        for quantity, digits in (("sigma_xx/sigma_yy", 3), ("Gamma", 3), ("p_o", 3), ("z", 3)):
            of = [(without, f"{quantity}@{tilt}", forces) for without, forces in codes.values()]
            rows.append([f"{quantity} at {tilt} deg", *(cell for each in of for cell in (with_error(both_codes(*each)[0], digits),
                                                                                      signed(with_error(differences(*each), digits))))])
    return markdown(["quantity", *(f"{head}, {which}" for head in heads for which in ("with forces", "change without"))], rows)


def rms(values):
    return math.sqrt(statistics.mean(value**2 for value in values))


def two_codes_programs(_):
    """One sentence: the programs and the number of beds."""
    rows = rows_of("two-codes-beds.csv")
    return f"Computed by {' and '.join(dict.fromkeys(row['version'] for row in rows))}: {len({row['seed'] for row in rows})} beds."


def two_codes_numbers(_):
    """CODE.QUANTITY, the mean by this code with its error; .less, its difference to Talus; .talus, that of Talus for the same beds; .rms, the
    root mean square of the difference; .beds, their number; .less_soft, the difference to lammps-1e5, and .less_forces, to the beds whose
    forces were carried over."""
    found = {}
    for code, quantities in two_codes_values().items():
        for quantity in quantities:
            own, other = both_codes(code, quantity)
            if own:
                means = {"": summary(other), ".less": summary(differences(code, quantity)), ".talus": summary(own)}
                found |= {f"{code}.{quantity}{suffix}": (mean["mean"], mean["error"]) for suffix, mean in means.items()}
                found |= {f"{code}.{quantity}.beds": len(own), f"{code}.{quantity}.rms": rms(differences(code, quantity))}
            for suffix, of, reference in (("less_soft", "lammps-1e6", "lammps-1e5"), ("less_forces", "positions", "talus"),
                                          ("less_forces", "lammps-positions", "lammps-1e5")):
                if code == of and (each := differences(code, quantity, reference)):
                    found[f"{code}.{quantity}.{suffix}"] = summary(each)["mean"], summary(each)["error"]
    return found


# ---- Tolerances.


def tolerance_rows():
    """The rows of tolerances.csv by variation and seed; those of the baseline under "baseline"."""
    by = {}
    for row in rows_of("tolerances.csv"):
        by.setdefault(row["variation"], {})[row["seed"]] = row
    return by


def tolerance_changes(members, baseline, key, scale=1.0):
    """Differences of a quantity to the baseline, bed by bed."""
    pairs = [(number(row[key]) * scale, number(baseline[seed][key]) * scale) for seed, row in members.items() if seed in baseline]
    return [ours - theirs for ours, theirs in pairs if not math.isnan(ours - theirs)]


def tolerances(_):
    by = tolerance_rows()
    baseline = by["baseline"]
    columns = [("iterations", "iterations_per_step", 1, 1), ("theta_c, deg", "theta_c_deg", 2, 1),
               ("volume strain at the reference, %", "volume_strain_at_reference", 3, 100), ("creep, % of H", "creep_at_reference", 2, 100),
               ("z", "coordination_number_at_reference", 4, 1), ("p_o", "overloaded_fraction_at_reference", 3, 1)]
    rows = []
    for name, members in by.items():
        if members is baseline:
            cells = [with_error([number(row[key]) * scale for row in members.values() if not math.isnan(number(row[key]))], digits)
                     for _, key, digits, scale in columns]
        else:
            cells = [with_error(tolerance_changes(members, baseline, key, scale), digits) for _, key, digits, scale in columns]
            cells = list(map(signed, cells))
        rows.append(["**baseline**, values" if members is baseline else f"`{name}`", str(len(members)), *cells])
    return markdown(["variation", "beds", *(column[0] for column in columns)], rows)


def tolerance_numbers(_):
    """Of each variation of tolerances.csv: VARIATION.restless, how many of the beds of the baseline it lacks because they did not come to rest;
    .theta_c, the mean difference to the baseline with its error, .theta_c.errors in errors."""
    by = tolerance_rows()
    baseline, found = by["baseline"], {}
    for name, members in by.items():
        each = summary(tolerance_changes(members, baseline, "theta_c_deg"))
        found |= {f"{name}.restless": len(baseline) - len(members), f"{name}.theta_c": (each["mean"], each["error"]),
                  f"{name}.theta_c.errors": each["errors"]}
    return found


def measured(beds, *names):
    """One sentence: which beds a report is about, by their groups or ensembles, and the program that computed them."""
    names = [SHORT.get(name, name) for name in names]
    members = {name: [bed for group in beds.groups if name in (group, group.split(":")[0]) for bed in beds.groups[group]] for name in names}
    if missing := [name for name in names if not members[name]]:
        raise KeyError(f"docs/data/beds.csv has no beds {missing[0]}")
    versions = {bed["version"] for name in names for bed in members[name]}
    each = [f"`{name}` ({len(members[name])} beds)" for name in names]
    text = " and ".join(filter(None, [", ".join(each[:-1]), each[-1]]))
    return f"Computed by Talus {' and '.join(sorted(versions))}: {text} ([how](README.md#how-to-repeat-a-study))."


TABLES = {"measured": measured, "preparation-flat": preparation_flat, "preparation-slope": preparation_slope, "preparation": preparation_manual,
          "directions": directions, "finite-size": finite_size, "time-steps": time_steps, "rates": rates, "fifty": fifty, "readings": readings, "walls": walls,
          "wall-coefficients": wall_coefficients, "rolling": rolling, "rolling-friction": rolling_friction, "metastability": metastability, "dynamic-angle": dynamic_angle, "events": events,
          "events-by-tilt": events_by_tilt, "announcing-failure": announcing, "cycles": cycles, "forces": forces, "tolerances": tolerances,
          "two-codes": two_codes, "two-codes-angles": two_codes_angles, "two-codes-programs": two_codes_programs,
          "two-codes-limits": two_codes_limits, "two-codes-memory": two_codes_memory}
#: Numbers of single reports.
REPORTS = {"walls": wall_numbers, "rates": rate_numbers, "readings": reading_numbers, "forces": force_numbers, "ranking": ranking_numbers, "metastability": metastability_numbers,
           "tolerances": tolerance_numbers, "two-codes": two_codes_numbers}
