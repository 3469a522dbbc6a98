"""The report as HTML: one file, without scripts, nothing of it from elsewhere."""

from __future__ import annotations

from html import escape
from urllib.parse import quote

from outcomes import DONE
from scan_results import ScanResults
from thumbnails import Thumbnail

STYLE = """
:root { color-scheme: light dark; --ground: #fbfbf9; --card: #fff; --text: #1c1c1a; --soft: #5c5c56; --line: #d9d9d2;
  --bad: #a3210f; --doubt: #7a5200; --link: #0b57a4; }
@media (prefers-color-scheme: dark) { :root { --ground: #161614; --card: #20201d; --text: #ecece6; --soft: #a9a9a0;
  --line: #3a3a35; --bad: #ff9b8a; --doubt: #f0c060; --link: #8fc3ff; } }
body { margin: 0 auto; max-width: 76rem; padding: 1.5rem; background: var(--ground); color: var(--text);
  font: 1rem/1.5 system-ui, sans-serif; }
h1 { font-size: 1.6rem; margin: 0; } h2 { font-size: 1.25rem; margin: 2.5rem 0 .5rem; } h3 { font-size: 1.1rem; margin: 0; }
p { margin: .4rem 0; } a { color: var(--link); } .soft { color: var(--soft); }
article { background: var(--card); border: 1px solid var(--line); border-radius: .5rem; padding: 1rem; margin: 1rem 0;
  content-visibility: auto; contain-intrinsic-size: auto 26rem; }
.head { display: flex; flex-wrap: wrap; gap: .3rem 1rem; align-items: baseline; justify-content: space-between; }
.gain { font-weight: 600; font-variant-numeric: tabular-nums; }
.bad { color: var(--bad); } .doubt { color: var(--doubt); }
.pictures { display: grid; grid-template-columns: repeat(auto-fill, minmax(11rem, 1fr)); gap: .5rem; margin: .7rem 0; }
figure { margin: 0; } figcaption { font-size: .85rem; color: var(--soft); }
img { width: 100%; height: auto; display: block; border-radius: .25rem; }
dl { display: grid; grid-template-columns: repeat(auto-fill, minmax(11rem, 1fr)); gap: .4rem .5rem; margin: .5rem 0; }
dt { font-size: .85rem; color: var(--soft); } dd { margin: 0; font-variant-numeric: tabular-nums; }
ul { margin: .4rem 0; padding-left: 1.2rem; } code { overflow-wrap: anywhere; }
@media print { article { break-inside: avoid; } }
"""


def page(scans: list[ScanResults], pictures: dict[str, list[Thumbnail]]) -> str:
    """All of it; `scans` in the order in which they shall stand, `pictures` by the names of scans."""
    without = [scan for scan in scans if not scan.room]
    rooms = [scan for scan in scans if scan.room]
    body = [_summary(scans, rooms)]
    if without:
        body.append('<section aria-labelledby="without"><h2 id="without">Without a result</h2>')
        body += [_refused(scan) for scan in without]
        body.append("</section>")
    if rooms:
        body.append(
            '<section aria-labelledby="rooms"><h2 id="rooms">Rooms</h2><p class="soft">By how much better places of '
            "one paint agree in the albedo than in the scan, under light that was found without looking at them. The "
            "smallest gain stands first.</p>"
        )
        body += [_room(scan, pictures.get(scan.name, [])) for scan in rooms]
        body.append("</section>")
    return (
        '<!DOCTYPE html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n'
        '<meta name="viewport" content="width=device-width, initial-scale=1">\n'
        f"<title>{_count(len(scans), 'scan')}</title>\n<style>{STYLE}</style>\n</head>\n<body>\n<main>\n"
        + "\n".join(body)
        + "\n</main>\n</body>\n</html>\n"
    )


def _count(number: int, thing: str) -> str:
    return f"{number:,} {thing}" + ("" if number == 1 else "s")


def _summary(scans: list[ScanResults], rooms: list[ScanResults]) -> str:
    doubtful = sum(1 for scan in rooms if _is_doubtful(scan))
    warned = sum(1 for scan in rooms if _warnings(scan))
    hours = sum(scan.core_seconds for scan in scans) / 3600
    parts = [
        f"{_count(len(rooms), 'room')} done",
        f"{len(scans) - len(rooms):,} without a result",
        f"{doubtful:,} in which the albedo is not clearly better than the scan",
        f"{warned:,} with warnings",
        f"{hours:.2f} core hours",
    ]
    return f"<h1>{_count(len(scans), 'scan')}</h1>\n<p>{'; '.join(parts)}.</p>"


def _refused(scan: ScanResults) -> str:
    return (
        f'<article class="refused"><div class="head"><h3>{escape(scan.name)}</h3></div>'
        f'<p class="soft"><code>{escape(scan.path)}</code></p>{_sentences(scan.problems, "bad")}</article>'
    )


def _room(scan: ScanResults, pictures: list[Thumbnail]) -> str:
    folder = quote(f"{scan.name}/room/")
    figures = "".join(f"<div><dt>{escape(what)}</dt><dd>{escape(value)}</dd></div>" for what, value in _figures(scan))
    shown = "".join(
        f'<figure><img src="{picture.uri}" width="{picture.width}" height="{picture.height}" loading="lazy" '
        f'alt="{escape(f"{scan.name}, {picture.shows}")}"><figcaption>{escape(picture.shows)}</figcaption></figure>'
        for picture in pictures
    )
    return (
        f'<article class="room"><div class="head"><h3><a href="{folder}">{escape(scan.name)}</a></h3>{_gain(scan)}</div>'
        f'<p class="soft"><code>{escape(scan.path)}</code></p>'
        + (f'<div class="pictures">{shown}</div>' if shown else "")
        + f"<dl>{figures}</dl>{_sentences(scan.problems, 'bad')}{_sentences(_warnings(scan), 'doubt')}</article>"
    )


def _is_doubtful(scan: ScanResults) -> bool:
    return scan.gain is None or not scan.report["crossValidation"].get("improves", False)


def _gain(scan: ScanResults) -> str:
    if scan.gain is None:
        return '<span class="gain doubt">no two places to compare</span>'
    doubt = " doubt" if _is_doubtful(scan) else ""
    return f'<span class="gain{doubt}">gain {scan.gain:.1f} dB</span>'


def _warnings(scan: ScanResults) -> list[str]:
    verified = scan.outcomes.get("verify")
    found = scan.report.get("warnings", []) + ((verified.printed or {}).get("warnings", []) if verified else [])
    return list(dict.fromkeys(found))  # each once


def _sentences(sentences: list[str], kind: str) -> str:
    if not sentences:
        return ""
    return f'<ul class="{kind}">' + "".join(f"<li>{escape(sentence)}</li>" for sentence in sentences) + "</ul>"


def _figures(scan: ScanResults) -> list[tuple[str, str]]:
    report = scan.report
    found = []
    if scan.gain is not None:
        paint = report["crossValidation"]
        found.append(("one paint differs by", f"{paint['scan']:.2f} stops, in the albedo {paint['albedo']:.2f}"))
    loop = report.get("closedLoop") or {}
    if loop:
        found.append(("not explained by the light", f"{loop['rmsError']:.3f} of {loop['rmsOfScan']:.3f}"))
    verified = scan.outcomes.get("verify")
    if verified and verified.outcome == DONE:
        found.append(("rendered again (verify)", f"{verified.printed['psnr']:.1f} dB"))
    found += [
        ("can be believed", f"{report['confidence']['good']:.0%} of the surface"),
        ("lamps and windows", str(len(report["lights"]["fixtures"]))),
        ("surface", f"{report['scan']['squareMetres']:.0f} m²"),
        ("texels", f"{report['scan']['texels'] / 1e6:.2f} million"),
        ("took", f"{scan.core_seconds:.0f} core seconds, {scan.megabytes / 1000:.2f} GB"),
    ]
    return found
