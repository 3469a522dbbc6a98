# What is done with one scan. Each step has its outcome for output; a step after one that was refused is passed over.


rule info:
    input:
        scan=scan_file,
    output:
        record("info"),
    log:
        f"{RESULTS}/{{name}}/logs/info.log",
    params:
        scan=scan_path,
        options=options("read_options"),
    threads: 1
    retries: RETRIES
    resources:
        mem_mb=lambda wildcards, input, attempt: attempt * (500 + 60 * int(input.size_mb)),
        runtime=lambda wildcards, attempt: 10 * attempt,
    shell:
        RUN + " --json -- {RELAMP:q} info {params.scan:q} --threads {threads} --json {params.options}"


rule delight:
    input:
        scan=scan_file,
        info=record("info"),
    output:
        record("delight"),
    log:
        f"{RESULTS}/{{name}}/logs/delight.log",
    params:
        scan=scan_path,
        room=lambda wildcards: f"{RESULTS}/{wildcards.name}/room",
        options=options("read_options", "delight_options"),
    threads: config["threads"]
    retries: RETRIES
    resources:
        mem_mb=megabytes("delight"),
        runtime=minutes("delight"),
    shell:
        RUN + " --after {input.info:q} --makes {params.room:q}/report.json"
        " -- {RELAMP:q} delight {params.scan:q} -o {params.room:q} --threads {threads} --quiet {params.options}"


rule verify:
    input:
        info=record("info"),
        delight=record("delight"),
    output:
        record("verify"),
    log:
        f"{RESULTS}/{{name}}/logs/verify.log",
    params:
        room=lambda wildcards: f"{RESULTS}/{wildcards.name}/room",
        scan=scan_path,
        options=options("verify_options"),
    threads: config["threads"]
    retries: RETRIES
    resources:
        mem_mb=megabytes("verify"),
        runtime=minutes("verify"),
    shell:
        RUN + " --after {input.delight:q} --json"
        " -- {RELAMP:q} verify {params.room:q} --scan {params.scan:q} --threads {threads} --json {params.options}"


rule relight:
    input:
        info=record("info"),
        delight=record("delight"),
    output:
        record("relight"),
    log:
        f"{RESULTS}/{{name}}/logs/relight.log",
    params:
        folder=lambda wildcards: f"{RESULTS}/{wildcards.name}",
        options=options("relight_options"),
        lights=lights,
        needs=lambda wildcards: [f"{name}={what}" for name, what in config["needs"].items() if what],
    threads: config["threads"]
    retries: RETRIES
    resources:
        mem_mb=megabytes("relight"),
        runtime=minutes("relight", runs=len(config["lights"])),
    shell:
        RUN + " --after {input.delight:q} --room {params.folder:q}/room --pictures {params.folder:q}/relit"
        " --lights {params.lights:q} --needs {params.needs:q}"
        " -- {RELAMP:q} relight {params.folder:q}/room --threads {threads} --quiet {params.options}"
