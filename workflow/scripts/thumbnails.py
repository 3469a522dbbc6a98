"""Small pictures as data URIs, so that the report is one file."""

from __future__ import annotations

import base64
import io
from dataclasses import dataclass
from pathlib import Path

from PIL import Image

WIDTH = 320
QUALITY = 80
PREVIEW = ["as scanned", "albedo", "shading"]  # the columns of preview.png


@dataclass
class Thumbnail:
    """A picture and what it shows."""

    shows: str
    uri: str
    width: int
    height: int


def thumbnails_of(scan_folder: Path) -> list[Thumbnail]:
    """The first view of the preview, column by column, and the relit pictures. What is not there,
    or cannot be read, is left out."""
    found = []
    if preview := _read(scan_folder / "room" / "preview.png"):
        width = preview.width // len(PREVIEW)
        height = min(width * 5 // 8, preview.height)  # of one view
        for column, shows in enumerate(PREVIEW):
            view = preview.crop((column * width, 0, (column + 1) * width, height))
            found.append(_thumbnail(shows, view))
    for file in sorted((scan_folder / "relit").glob("*.png")):
        if picture := _read(file):
            found.append(_thumbnail(f"relit: {file.stem.replace('_', ' ')}", picture))
    return found


def _read(file: Path) -> Image.Image | None:
    try:
        return Image.open(file).convert("RGB")
    except OSError:  # not there, not whole, no picture
        return None


def _thumbnail(shows: str, image: Image.Image) -> Thumbnail:
    size = (WIDTH, round(WIDTH * image.height / image.width))
    small = image.resize(size, Image.Resampling.LANCZOS)
    jpeg = io.BytesIO()
    small.save(jpeg, "JPEG", quality=QUALITY, optimize=True)
    uri = "data:image/jpeg;base64," + base64.b64encode(jpeg.getvalue()).decode()
    return Thumbnail(shows, uri, small.width, small.height)
