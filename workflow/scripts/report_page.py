"""The report as HTML: one file, without scripts, nothing of it from elsewhere."""

from __future__ import annotations

from html import escape
from pathlib import Path
from urllib.parse import quote

from outcomes import DONE
from scan_results import ScanResults
from thumbnails import Thumbnail

STYLE = Path(__file__).with_name("report.css")


def page(scans: list[ScanResults], pictures: dict[str, list[Thumbnail]]) -> str:
    """All of it; `scans` as they shall stand, `pictures` by the names of scans."""
    without = [scan for scan in scans if not scan.room]
    rooms = [scan for scan in scans if scan.room]
    body = [_summary(scans, rooms)]
    if without:
        body.append('<section aria-labelledby="without"><h2 id="without">Without a result</h2>')
        body += [_refused(scan) for scan in without]
        body.append("</section>")
    if rooms:
        body.append(
            '<section aria-labelledby="rooms"><h2 id="rooms">Rooms</h2><p class="soft">'
            "By how much better places of one paint agree in the albedo than in the scan, under "
            "light that was found without looking at them. The smallest gain stands first.</p>"
        )
        body += [_room(scan, pictures.get(scan.name, [])) for scan in rooms]
        body.append("</section>")
    return (
        '<!DOCTYPE html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n'
        '<meta name="viewport" content="width=device-width, initial-scale=1">\n'
        f"<title>{_count(len(scans), 'scan')}</title>\n"
        f"<style>\n{STYLE.read_text(encoding='utf-8')}</style>\n</head>\n<body>\n<main>\n"
        + "\n".join(body)
        + "\n</main>\n</body>\n</html>\n"
    )


def _count(number: int, thing: str) -> str:
    return f"{number:,} {thing}" + ("" if number == 1 else "s")


def _summary(scans: list[ScanResults], rooms: list[ScanResults]) -> str:
    doubtful = sum(1 for scan in rooms if _is_doubtful(scan))
    warned = sum(1 for scan in rooms if _warnings(scan))
    hours = sum(scan.core_seconds for scan in scans) / 3600
    counted = [
        (len(scans) - len(rooms), "without a result"),
        (doubtful, "whose albedo is not clearly better than the scan"),
        (warned, "with warnings"),
    ]
    parts = [f"{_count(len(rooms), 'room')} done"]
    parts += [f"{number:,} {what}" for number, what in counted if number]
    parts.append(f"{hours:.2f} core hours")
    return f"<h1>{_count(len(scans), 'scan')}</h1>\n<p>{'; '.join(parts)}.</p>"


def _refused(scan: ScanResults) -> str:
    return (
        f'<article class="refused"><h3>{escape(scan.name)}</h3>'
        f'<p class="soft"><code>{escape(scan.path)}</code></p>'
        f'{_sentences(scan.problems, "bad")}</article>'
    )


def _room(scan: ScanResults, pictures: list[Thumbnail]) -> str:
    folder = quote(f"{scan.name}/room/")
    shown = "".join(_figure(scan.name, picture) for picture in pictures)
    figures = "".join(
        f"<div><dt>{escape(what)}</dt><dd>{escape(value)}</dd></div>"
        for what, value in _figures(scan)
    )
    return (
        '<article class="room"><div class="head">'
        f'<h3><a href="{folder}">{escape(scan.name)}</a></h3>{_gain(scan)}</div>'
        f'<p class="soft"><code>{escape(scan.path)}</code></p>'
        + (f'<div class="pictures">{shown}</div>' if shown else "")
        + f"<dl>{figures}</dl>{_sentences(scan.problems, 'bad')}"
        + f"{_sentences(_warnings(scan), 'doubt')}</article>"
    )


def _figure(name: str, picture: Thumbnail) -> str:
    return (
        f'<figure><img src="{picture.uri}" width="{picture.width}" height="{picture.height}" '
        f'loading="lazy" alt="{escape(f"{name}, {picture.shows}")}">'
        f"<figcaption>{escape(picture.shows)}</figcaption></figure>"
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
    found = list(scan.report.get("warnings", []))
    if verified and verified.printed:
        found += verified.printed.get("warnings", [])
    return list(dict.fromkeys(found))  # each once


def _sentences(sentences: list[str], kind: str) -> str:
    if not sentences:
        return ""
    items = "".join(f"<li>{escape(sentence)}</li>" for sentence in sentences)
    return f'<ul class="{kind}">{items}</ul>'


def _figures(scan: ScanResults) -> list[tuple[str, str]]:
    report = scan.report
    found = []
    if scan.gain is not None:
        paint = report["crossValidation"]
        stops = f"{paint['scan']:.2f}, now {paint['albedo']:.2f}"
        found.append(("stops in a paint", stops))
    loop = report.get("closedLoop") or {}
    if loop:
        left = f"{loop['rmsError']:.3f} of {loop['rmsOfScan']:.3f}"
        found.append(("unexplained", left))
    verified = scan.outcomes.get("verify")
    if verified and verified.outcome == DONE:
        found.append(("rendered again", f"{verified.printed['psnr']:.1f} dB"))
    found += [
        ("surface", f"{report['scan']['squareMetres']:.0f} m²"),
        ("can be believed", f"{report['confidence']['good']:.0%} of it"),
        ("lamps, windows", str(len(report["lights"]["fixtures"]))),
        ("texels", f"{report['scan']['texels'] / 1e6:.2f} million"),
        ("core seconds, GB", f"{scan.core_seconds:.0f}, {scan.megabytes / 1000:.1f}"),
    ]
    return found
