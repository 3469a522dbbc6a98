# One page about all scans.
import shlex


def report_command() -> str:
    words = [PYTHON, SCRIPTS / "report.py", config["scans"], RESULTS, "-o", f"{RESULTS}/report.html"]
    words += ["--thumbnails", config["thumbnails"]]
    return " ".join(shlex.quote(str(word)) for word in words)


RECORDS = [record(step).format(name=name) for name in SCANS for step in STEPS]


rule report:
    input:
        RECORDS,
    output:
        f"{RESULTS}/report.html",
    params:
        command=report_command(),
    shell:
        "{params.command}"
