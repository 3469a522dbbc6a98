# The list of scans, and what the rules have in common.
import importlib.util
import shlex
import shutil
import sys
from pathlib import Path

from snakemake.exceptions import WorkflowError

WORKFLOW = Path(workflow.basedir)
SCRIPTS = WORKFLOW / "scripts"
LIGHTS = WORKFLOW.parent / "config" / "lights"
sys.path.insert(0, str(SCRIPTS))

from outcomes import forget  # noqa: E402
from resources import Estimate  # noqa: E402
from scan_list import ListError, read_scans  # noqa: E402

RESULTS = config["results"].rstrip("/")
STEPS = ["info", "delight", "verify", "relight"]
PYTHON = sys.executable


def command_of(script: str) -> str:
    """One of the scripts, as a shell takes it; Snakemake takes braces for its own."""
    return shlex.join([PYTHON, str(SCRIPTS / script)]).replace("{", "{{").replace("}", "}}")


def started_by_people() -> bool:
    """And not by Snakemake, for one job."""
    if hasattr(workflow, "mode"):
        return workflow.mode == 0  # Snakemake 7
    return not (workflow.remote_exec or workflow.subprocess_exec)  # 8 and later


def program() -> str:
    """relamp as configured, or that of this checkout's build where PATH has none."""
    built = WORKFLOW.parent / "build" / "release" / "apps" / "cli" / "relamp"
    found = shutil.which(config["relamp"]) or (config["relamp"] == "relamp" and shutil.which(built))
    if not found:
        raise WorkflowError(
            f"{config['relamp']}: no such program. Install relamp, or say where it is: --config relamp=PATH"
        )
    return str(found)


try:
    SCANS = {scan.name: scan for scan in read_scans(Path(config["scans"]))}
except ListError as error:
    raise WorkflowError(str(error))
RELAMP = program()

# A job parses this file, too; only the process that people start looks at what is there.
if started_by_people():
    if importlib.util.find_spec("PIL") is None:
        raise WorkflowError("The report needs Pillow for its pictures: apt-get install python3-pil")
    forget(Path(RESULTS), SCANS, STEPS, refused=str(config["again"]).lower() == "true")


# In a job of a cluster, which is a Snakemake of its own, a second attempt would have the memory of the first.
RETRIES = config["retries"] if started_by_people() else 0


wildcard_constraints:
    name="[^/]+",


def record(step: str) -> str:
    """What a step writes in the end: its outcome. What it made stands beside, in the scan's folder."""
    return f"{RESULTS}/{{name}}/{step}.json"


def scan_path(wildcards):
    return SCANS[wildcards.name].path


def scan_file(wildcards):
    """Nothing where a table names a file that is not there: relamp says so, and Snakemake would stop all."""
    path = scan_path(wildcards)
    return [path] if Path(path).exists() else []


def options(*keys):
    """Options of the configuration and of the table's row, as one string of the command line."""

    def of_scan(wildcards):
        scan = SCANS[wildcards.name]
        return " ".join(f"{config[key] or ''} {scan.options.get(key, '')}".strip() for key in keys).strip()

    return of_scan


def lights(wildcards):
    """NAME=OPTIONS of each of the standard lights."""
    folder = shlex.quote(str(LIGHTS))
    return [f"{name}={what.replace('{lights}', folder)}" for name, what in config["lights"].items() if what]


def megabytes(step):
    def of_job(wildcards, input, attempt):
        return Estimate(config["resources"], input.info).megabytes(step, attempt)

    return of_job


def minutes(step, runs=1):
    def of_job(wildcards, input, attempt, threads):
        return Estimate(config["resources"], input.info).minutes(step, attempt, threads, runs)

    return of_job


# Runs relamp and writes the outcome; what relamp refuses is an outcome, what was killed is a failure of the job.
RUN = command_of("run_relamp.py") + " {output:q} --log {log:q}"
