"""One run of relamp, beside Blender: what it says, how far it is, and its end."""

from __future__ import annotations

import queue
import re
import signal
import subprocess
import threading
import time

from .errors import Refusal

STAGE = re.compile(r"^  (.+?) +(\d+) %$")
PATIENCE = 10  # seconds that relamp has to end when it is asked to; it wants one
# Shares of a run's time after which a stage usually begins; what takes long does so in every scan.
BEGINS = {"read": 0.0, "bvh": 0.02, "texels": 0.03, "enclosed texels": 0.05, "lights": 0.08,
          "rays": 0.09, "openings": 0.31, "lamps": 0.35, "sun": 0.64, "shadows": 0.65,
          "divide": 0.88, "write": 0.92}
ENDS = dict(zip(BEGINS, [*list(BEGINS.values())[1:], 1.0]))


class Run:
    """relamp as a child; poll() now and then."""

    def __init__(self, command: list[str], scan: str = ""):
        """`scan`: a file in `command` that a person knows nothing of, and is not told of."""
        self._scan = scan
        try:
            self.child = subprocess.Popen(command, stdin=subprocess.DEVNULL,
                                          stdout=subprocess.DEVNULL, stderr=subprocess.PIPE,
                                          text=True, encoding="utf-8", errors="replace")
        except OSError as error:
            raise Refusal(f"{command[0]} cannot be run: {error.strerror}; see Edit > Preferences > "
                          "Add-ons > relamp") from error
        self.stage = "starts"
        self.fraction = 0.0  # of the whole
        self.said: list[str] = []  # but for progress
        self._lines: queue.SimpleQueue[str] = queue.SimpleQueue()
        self._reader = threading.Thread(target=self._read, daemon=True)
        self._reader.start()

    def poll(self) -> bool:
        """Takes in what was said; whether it has ended."""
        ended = self.child.poll() is not None and not self._reader.is_alive()
        while not self._lines.empty():
            self._take(self._lines.get())
        return ended

    def cancel(self) -> None:
        """Ends it; nothing half-written stays."""
        if self.child.poll() is None:
            self.child.send_signal(signal.SIGINT)
            try:
                self.child.wait(PATIENCE)
            except subprocess.TimeoutExpired:
                self.child.kill()
                self.child.wait()
        self._reader.join(PATIENCE)

    def check(self) -> None:
        """Throws Refusal with relamp's own sentence, where it ended badly."""
        code = self.child.returncode
        if code == 0:
            return
        if code < 0:
            raise Refusal(f"relamp was ended by signal {-code}, as a machine that is out of memory "
                          "does; close other programs, or try the quality draft")
        raise Refusal(self._sentence() or f"relamp ended with exit code {code} without a word")

    def notes(self) -> list[str]:
        return [line.removeprefix("relamp: note: ") for line in self.said
                if line.startswith("relamp: note: ")]

    def _sentence(self) -> str:
        told = [line for line in self.said if not line.startswith("relamp: note: ")]
        whole = " ".join(line.removeprefix("relamp: ").strip() for line in told)
        return whole.replace(self._scan, "the scan") if self._scan else whole

    def _read(self) -> None:
        for line in self.child.stderr:
            self._lines.put(line.rstrip("\n"))
        self.child.stderr.close()

    def _take(self, line: str) -> None:
        stage = STAGE.match(line)
        if stage:
            self.stage = f"{stage[1]} {stage[2]} %"
            begin, end = BEGINS.get(stage[1], self.fraction), ENDS.get(stage[1], self.fraction)
            # Some stages come again within others; the whole never goes back.
            self.fraction = max(self.fraction, begin + (end - begin) * int(stage[2]) / 100)
        elif line:
            self.said.append(line)


def wait(run: Run, every: float = 0.05) -> None:
    """Until it has ended, where nobody looks."""
    while not run.poll():
        time.sleep(every)
