# One page about all scans.
def report_command() -> str:
    words = [config["scans"], RESULTS, "-o", f"{RESULTS}/report.html", "--thumbnails", str(config["thumbnails"])]
    return shlex.join([PYTHON, str(SCRIPTS / "report.py"), *words])


RECORDS = [record(step).format(name=name) for name in SCANS for step in STEPS]


rule report:
    input:
        RECORDS,
    output:
        f"{RESULTS}/report.html",
    params:
        command=lambda wildcards: report_command(),
    shell:
        "{params.command}"
