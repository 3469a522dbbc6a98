import os
import signal
import threading
import time

import pytest
import relamp


def test_ctrl_c_ends_it_soon(sample):
    began = []

    def interrupt(stage, share):
        if not began:
            began.append(time.monotonic())
            os.kill(os.getpid(), signal.SIGINT)

    with pytest.raises(KeyboardInterrupt):
        relamp.delight(sample, quality="high", progress=interrupt)
    assert time.monotonic() - began[0] < 2


def test_what_progress_raises_comes_out(sample):
    def refuse(stage, share):
        raise LookupError(stage)

    with pytest.raises(LookupError):
        relamp.delight(sample, quality="draft", progress=refuse)


def test_progress_names_stages_and_shares(sample):
    seen = []
    relamp.delight(sample, quality="draft", progress=lambda stage, share: seen.append((stage, share)))
    assert len({stage for stage, _ in seen}) > 2
    assert all(0 <= share <= 1 for _, share in seen)


def test_progress_as_a_bar(sample, capsys):
    pytest.importorskip("tqdm")
    relamp.delight(sample, quality="draft", progress=True)
    assert "rays" in capsys.readouterr().err


def test_other_threads_go_on_and_results_are_the_same(sample, room):
    """Held by the work, the lock would let the counter come as far as its first step."""
    counted, done, rooms = [0], threading.Event(), []

    def count():
        while not done.is_set():
            counted[0] += 1
            time.sleep(0.005)

    workers = [
        threading.Thread(target=lambda: rooms.append(relamp.delight(sample, quality="draft")))
        for _ in range(2)
    ]
    counter = threading.Thread(target=count)
    counter.start()
    for worker in workers:
        worker.start()
    for worker in workers:
        worker.join()
    done.set()
    counter.join()
    assert counted[0] > 20
    assert all((other.albedo == room.albedo).all() for other in rooms) and len(rooms) == 2


@pytest.mark.parametrize(
    "keywords, word",
    [
        (dict(solver="magic"), "solver"),
        (dict(rays=3), "rays=3"),
        (dict(samples=0), "samples=0"),
        (dict(longest_side=-1), "longest_side"),
        (dict(darkest=float("nan")), "darkest"),
        (dict(seed=-1), "seed"),
        (dict(threads=-1), "threads"),
        (dict(white=[(0, 0, float("inf"))]), "white"),
        (dict(white=[(0, 0, 1e300)]), "white"),
        (dict(white=[(1, 2), (3, 4), (5, 6)]), "white"),
        (dict(same=[((0, 0, 0),)]), "same"),
        (dict(lights="lights.json", no_sun=True), "no_sun"),
        (dict(up="x"), "up"),
    ],
)
def test_wrong_keyword_is_a_sentence(sample, keywords, word):
    with pytest.raises(ValueError, match=word):
        relamp.delight(sample, **keywords)


def test_keyword_that_there_is_not(sample):
    with pytest.raises(TypeError, match="unexpected keyword argument 'rayz'"):
        relamp.delight(sample, rayz=3)


def test_lights_of_a_file_that_is_not_there(sample):
    with pytest.raises(relamp.Error, match="nowhere.json"):
        relamp.delight(sample, lights="nowhere.json")
