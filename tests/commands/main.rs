//! The commands as others rely on them: files, exit codes, one-line errors, resuming.

mod automaton;
mod contour_cloud;
mod crystal;
mod snow;
mod volume;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::time::Duration;

fn snowglobe(folder: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_snowglobe")).args(arguments).current_dir(folder).output().unwrap()
}

fn home() -> tempfile::TempDir {
    tempfile::tempdir().unwrap()
}

fn ours(file: &str) -> String {
    format!("{}/{file}", env!("CARGO_MANIFEST_DIR"))
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

/// Wrong usage: exit code 2, one line on standard error that has these words, nothing on standard output.
fn refused(folder: &Path, arguments: &[&str], words: &[&str]) {
    let output = snowglobe(folder, arguments);
    let line = text(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{arguments:?}: {line}");
    assert_eq!(line.lines().count(), 1, "{arguments:?}: {line}");
    assert!(output.stdout.is_empty(), "{arguments:?}: {}", text(&output.stdout));
    for word in words {
        assert!(line.contains(word), "{arguments:?}: `{word}` is not in: {line}");
    }
}

fn columns(path: &Path) -> String {
    text(&fs::read(path).unwrap()).lines().next().unwrap().to_owned()
}

/// A disc of 37 cells.
fn small_region(folder: &Path) -> PathBuf {
    let mut csv = String::from("q,r\n");
    for r in -3i32..=3 {
        for q in -3i32..=3 {
            if (q + r).abs() <= 3 {
                csv += &format!("{q},{r}\n");
            }
        }
    }
    let path = folder.join("region.csv");
    fs::write(&path, csv).unwrap();
    path
}

#[test]
fn narrower_runs_need_a_folder_of_their_own() {
    let project = Path::new(env!("CARGO_MANIFEST_DIR"));
    for narrower in [
        &["run", "amano"][..],
        &["run", "amano/table-1"],
        &["run", "--scale", "smoke"],
        &["run", "--seed", "2"],
        &["run", "--reading", "inflow=as-printed"],
        &["--seed", "2"],
    ] {
        refused(project, narrower, &["--out", "results/"]);
    }
    refused(home().path(), &["report"], &["not inside the project"]);
}

#[test]
fn what_is_not_accepted_is_named_with_what_would_be() {
    let home = home();
    refused(home.path(), &["run", "amano/table-9", "--out", "o"], &["amano/table-9", "amano/table-1"]);
    refused(home.path(), &["run", "--reading", "inflow=wrong", "--out", "o"], &["inflow=reiter-gated"]);
    refused(home.path(), &["run", "--scale", "huge", "--out", "o"], &["paper", "smoke"]);
    refused(home.path(), &["run", "--threads", "0", "--out", "o"], &["--threads", "1 to 1024"]);
    refused(home.path(), &["check", "--format", "xml"], &["junit", "markdown"]);
    refused(home.path(), &["melt"], &["melt"]);
    refused(
        home.path(),
        &["optimizers", "--solver", "magic", "--out", "o"],
        &["magic", "cma-es", "brent-root"],
    );
    refused(home.path(), &["optimizers", "--problem", "lake", "--out", "o"], &["lake", "hexagon-0.8-100"]);
    refused(home.path(), &["optimizers", "snow", "--out", "o"], &["snow", "frost-whole", "control"]);
    refused(home.path(), &["optimizers", "--budget", "0", "--out", "o"], &["--budget", "1"]);
    refused(home.path(), &["optimizers", "--seeds", "-3", "--out", "o"], &["--seeds", "1"]);
    refused(home.path(), &["optimizers", "--seeds", "2"], &["--out", "results/"]);
    refused(home.path(), &["diff", "a", "b"], &["findings"]);
    assert!(fs::read_dir(home.path()).unwrap().next().is_none(), "a refusal leaves nothing behind");
}

#[test]
fn list_has_every_claim_with_all_that_is_asked_for() {
    let output = snowglobe(Path::new(env!("CARGO_MANIFEST_DIR")), &["list", "--format", "json"]);
    let list: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    let claims: Vec<&serde_json::Value> = list["papers"]
        .as_array()
        .unwrap()
        .iter()
        .flat_map(|paper| paper["experiments"].as_array().unwrap())
        .flat_map(|experiment| experiment["claims"].as_array().unwrap())
        .collect();
    assert!(claims.len() > 20);
    for claim in claims {
        for key in ["id", "source", "says", "expected", "tolerance", "reason", "known"] {
            assert!(claim.get(key).is_some(), "{key} is missing in {claim}");
        }
    }
    assert!(!list["papers"][0]["readings"].as_array().unwrap().is_empty());
    assert!(!list["papers"][0]["assumptions"].as_array().unwrap().is_empty());
}

/// Another solver, fewer seeds, a smaller budget: what the runtime table says is what the log says.
#[test]
fn optimizers_narrowed_keep_their_files_and_columns() {
    let home = home();
    let arguments = [
        "optimizers",
        "--problem",
        "hexagon-0.8-60",
        "--problem",
        "holes-0-100",
        "--solver",
        "secant",
        "--solver",
        "particle-swarm",
        "--solver",
        "nonlinear-cg",
        "--seeds",
        "2",
        "--budget",
        "12",
        "--out",
        "o",
    ];
    let output = snowglobe(home.path(), &arguments);
    assert!(output.status.success(), "{}", text(&output.stderr));
    for suite in ["frost-whole", "frost-interpolated"] {
        let folder = home.path().join("o/optimizers").join(suite);
        assert_eq!(
            columns(&folder.join("runtime.csv")),
            "problem,solver,seed,target,evaluations,status,reason"
        );
        assert_eq!(columns(&folder.join("large/log.csv")), "problem,solver,seed,evaluation,x,f");
        let rows = |file: &str| -> Vec<Vec<String>> {
            let mut reader = csv::Reader::from_path(folder.join(file)).unwrap();
            reader.records().map(|r| r.unwrap().iter().map(String::from).collect()).collect()
        };
        let (runtime, log) = (rows("runtime.csv"), rows("large/log.csv"));
        assert_eq!(runtime.len(), 2 * 3 * 2 * 5, "problems, solvers, seeds, targets: nobody is missing");
        for row in runtime {
            let target: f64 = row[3].parse().unwrap();
            let mine: Vec<&Vec<String>> = log.iter().filter(|other| other[..3] == row[..3]).collect();
            assert!(mine.len() <= 12);
            let hit = |other: &&&Vec<String>| other[5].parse::<f64>().unwrap() <= target * target;
            let evaluations = match mine.iter().find(hit) {
                Some(first) => (first[3].clone(), "reached".to_owned()),
                None => (mine.len().to_string(), row[5].clone()),
            };
            assert_eq!((row[4].clone(), row[5].clone()), evaluations, "{row:?}");
            assert_eq!(row[6].is_empty(), row[5] == "reached", "{row:?}");
        }
        assert_eq!(rows("findings.csv").len(), 0, "a narrowed run judges no claim");
    }
    assert!(!home.path().join("o/optimizers/control").exists(), "it has none of these problems");
}

#[test]
fn a_run_that_is_killed_resumes_and_loses_nothing() {
    let home = home();
    let arguments = ["run", "--scale", "smoke", "--out", "o", "--threads", "1"];
    let whole = |out: &Path| {
        let folders = |of: &Path| -> Vec<PathBuf> {
            fs::read_dir(of).map(|all| all.flatten().map(|e| e.path()).collect()).unwrap_or_default()
        };
        let experiments = folders(out).into_iter().flat_map(|paper| folders(&paper));
        experiments.filter(|path| path.join("provenance.json").is_file()).count()
    };
    let mut finished = 0;
    for pause in [5, 40, 80, 160, 320] {
        let mut child = Command::new(env!("CARGO_BIN_EXE_snowglobe"))
            .args(arguments)
            .current_dir(home.path())
            .stdout(Stdio::null())
            .spawn()
            .unwrap();
        std::thread::sleep(Duration::from_millis(pause));
        let _ = child.kill(); // it may have finished
        child.wait().unwrap();
        let now = whole(&home.path().join("o"));
        assert!(now >= finished, "{now} whole experiments after {finished}");
        finished = now;
    }
    let last = snowglobe(home.path(), &arguments);
    assert!(last.status.success());
    let fresh = text(&last.stdout).lines().filter(|line| line.ends_with("fresh")).count();
    assert_eq!(fresh, finished, "{}", text(&last.stdout));
    let again = text(&snowglobe(home.path(), &arguments).stdout);
    assert!(again.lines().all(|line| line.ends_with("fresh")), "{again}");
    for file in walk(&home.path().join("o")) {
        assert!(!file.to_string_lossy().ends_with(".part"), "{}", file.display());
    }
}

fn walk(folder: &Path) -> Vec<PathBuf> {
    fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .flat_map(|path| if path.is_dir() { walk(&path) } else { vec![path] })
        .collect()
}

#[test]
fn what_was_edited_or_removed_is_made_again_and_what_is_foreign_goes() {
    let home = home();
    let arguments = ["run", "amano/figure-2", "--scale", "smoke", "--out", "o"];
    assert!(snowglobe(home.path(), &arguments).status.success());
    let folder = home.path().join("o/amano/figure-2");
    let cells = fs::read(folder.join("cells.csv")).unwrap();
    let fresh = || text(&snowglobe(home.path(), &arguments).stdout).contains("fresh");
    assert!(fresh());
    fs::write(folder.join("cells.csv"), "q,r\n").unwrap();
    assert!(!fresh());
    assert_eq!(fs::read(folder.join("cells.csv")).unwrap(), cells);
    fs::remove_file(folder.join("algorithm.svg")).unwrap();
    fs::write(folder.join("foreign.txt"), "x").unwrap();
    assert!(!fresh());
    assert!(folder.join("algorithm.svg").is_file() && !folder.join("foreign.txt").exists());
    fs::remove_file(folder.join("run.toml")).unwrap();
    assert!(!fresh());
    assert!(fresh());
    // A value that is replaced is said, old and new.
    let findings = folder.join("findings.csv");
    let wrong = text(&fs::read(&findings).unwrap()).replace(",0.355,", ",0.5,");
    fs::write(&findings, wrong).unwrap();
    let told = text(&snowglobe(home.path(), &arguments).stdout);
    assert!(told.contains("0.5 (undecided) -> 0.355 (undecided)"), "{told}");
}

#[test]
fn two_runs_in_one_folder_do_not_mix() {
    let home = home();
    let arguments = ["run", "amano/figure-2", "--out", "o"];
    assert!(snowglobe(home.path(), &arguments).status.success());
    let lock = fs::File::options().write(true).open(home.path().join("o/.lock")).unwrap();
    lock.lock().unwrap();
    let second = snowglobe(home.path(), &arguments);
    assert_eq!(second.status.code(), Some(1));
    assert!(text(&second.stderr).contains("process "), "{}", text(&second.stderr));
}

#[test]
fn check_passes_on_what_a_run_wrote_and_names_what_changed() {
    let home = home();
    assert!(snowglobe(home.path(), &["run", "amano/figure-2", "--out", "o"]).status.success());
    let check = |more: &[&str]| {
        snowglobe(home.path(), &[&["check", "amano/figure-2", "--results", "o"], more].concat())
    };
    assert!(check(&["--exact"]).status.success());
    let xml = text(&check(&["--format", "junit"]).stdout);
    let page = roxmltree::Document::parse(&xml).unwrap();
    assert_eq!(page.root_element().tag_name().name(), "testsuites");
    assert_eq!(page.root_element().attribute("failures"), Some("0"));
    // As printed, the claim fails; unchanged, it is a passed case.
    assert!(xml.contains("verdict: fails"));

    let findings = home.path().join("o/amano/figure-2/findings.csv");
    let original = text(&fs::read(&findings).unwrap());
    fs::write(&findings, original.replace(",0.355,,fails", ",0.356,,holds")).unwrap();
    let changed = check(&[]);
    assert_eq!(changed.status.code(), Some(1));
    assert!(text(&changed.stdout).contains("0.356 (holds) -> 0.355 (fails)"), "{}", text(&changed.stdout));

    // Within rounding: equal, which is enough unless it must be exact.
    fs::write(&findings, original.replace(",0.355,,fails", ",0.35500000000001,,fails")).unwrap();
    assert!(check(&[]).status.success());
    assert_eq!(check(&["--exact"]).status.code(), Some(1));
    fs::write(&findings, &original).unwrap();

    let run = home.path().join("o/amano/figure-2/run.toml");
    let record = text(&fs::read(&run).unwrap());
    fs::write(&run, record.replacen("reason = \"", "reason = \"once: ", 1)).unwrap();
    assert_eq!(check(&[]).status.code(), Some(1), "a reason that changed");
    fs::write(&run, record).unwrap();
    assert!(check(&["--exact"]).status.success());

    assert!(snowglobe(home.path(), &["run", "amano/figure-2", "--out", "p"]).status.success());
    let same = text(&snowglobe(home.path(), &["diff", "o", "p"]).stdout);
    assert!(same.starts_with("0 claims differ"), "{same}");
}

#[test]
fn frost_writes_what_it_promises() {
    let home = home();
    small_region(home.path());
    let arguments = ["frost", "--cells", "region.csv", "--start", "0,0", "--beta", "0.4", "--width", "100"];
    let output = snowglobe(home.path(), &arguments);
    assert!(output.status.success(), "{}", text(&output.stderr));
    let out = home.path().join("out/frost");
    assert_eq!(columns(&out.join("growth.csv")), "frame,ice,cells");
    let growth = text(&fs::read(out.join("growth.csv")).unwrap());
    assert_eq!(growth.lines().nth(1), Some("0,1,37"));
    let summary: serde_json::Value =
        serde_json::from_slice(&fs::read(out.join("summary.json")).unwrap()).unwrap();
    let t = summary["t_sim"].as_u64().unwrap();
    assert_eq!(growth.lines().count() as u64, t + 2);
    assert_eq!(summary["cells"], 37);
    assert_eq!(summary["seed"], 1);
    let crossing = summary["t_sim_interpolated"].as_f64().unwrap();
    assert!(crossing > (t - 1) as f64 && crossing <= t as f64);
    assert!(out.join(format!("frames/frame-{t:05}.png")).is_file());
    for file in ["animation.png", "age.npy", "age.png", "points.ply"] {
        assert!(out.join(file).is_file(), "{file}");
    }
    // The folder is the command's own: it may be written again, and keeps what a user put there.
    fs::write(out.join("mine.txt"), "x").unwrap();
    assert!(snowglobe(home.path(), &[&arguments[..], &["--frames", "2"]].concat()).status.success());
    assert_eq!(text(&fs::read(out.join("growth.csv")).unwrap()).lines().count(), 4);
    assert!(!out.join("frames/frame-00003.png").exists() && out.join("mine.txt").is_file());
    // Another folder that is not empty is not.
    refused(home.path(), &[&arguments[..], &["--out", "."]].concat(), &["not empty", "--out"]);
}

#[test]
fn frost_is_photographed_on_a_bent_lattice() {
    let home = home();
    let sketch = ours("experiments/data/word.svg");
    let grow = [
        "frost", "--sketch", &sketch, "--points", "3000", "--beta", "0.5", "--frames", "3", "--width", "100",
    ];
    let look = ["--warp", "50", "--shaded", "--size", "160x90"];
    let output = snowglobe(home.path(), &[&grow[..], &look].concat());
    assert!(output.status.success(), "{}", text(&output.stderr));
    let out = home.path().join("out/frost");
    for frame in 0..=3 {
        assert!(out.join(format!("shaded/frame-{frame:05}.png")).is_file());
    }
    let last = fs::read(out.join("shaded/frame-00003.png")).unwrap();
    assert_eq!(fs::read(out.join("shaded.png")).unwrap(), last);
    let points = |out: &Path| text(&fs::read(out.join("points.ply")).unwrap());
    let bent = points(&out);
    let summary: serde_json::Value =
        serde_json::from_slice(&fs::read(out.join("summary.json")).unwrap()).unwrap();
    assert_eq!(summary["warp_degrees"], 50.0);
    // Without the flags there are no photographs, and those of before are gone.
    assert!(snowglobe(home.path(), &grow).status.success());
    assert!(!out.join("shaded.png").exists() && !out.join("shaded/frame-00000.png").exists());
    assert_ne!(points(&out), bent);
    for (wrong, word) in [(["--warp", "85"], "--warp"), (["--size", "90x90"], "--shaded")] {
        refused(home.path(), &[&grow[..], &wrong].concat(), &[word]);
    }
    refused(home.path(), &[&grow[..], &["--shaded", "--size", "9x9"]].concat(), &["--size", "64"]);
}

#[test]
fn frost_finds_the_initial_value_for_a_frame() {
    let home = home();
    let sketch = ours("experiments/data/mitten.png");
    let output = snowglobe(
        home.path(),
        &["frost", "--sketch", &sketch, "--points", "500", "--target", "50", "--width", "100", "--out", "o"],
    );
    assert!(output.status.success(), "{}", text(&output.stderr));
    let summary: serde_json::Value =
        serde_json::from_slice(&fs::read(home.path().join("o/summary.json")).unwrap()).unwrap();
    assert!((summary["t_sim"].as_f64().unwrap() - 50.0).abs() <= 4.0);
    let iterates = text(&fs::read(home.path().join("o/iterates.csv")).unwrap());
    assert_eq!(
        iterates.lines().count() - 1,
        text(&output.stdout).lines().filter(|l| l.contains("beta")).count()
    );
    // The value found gives the same film by itself.
    let beta = summary["beta"].to_string();
    let again =
        ["frost", "--sketch", &sketch, "--points", "500", "--beta", &beta, "--width", "100", "--out", "p"];
    assert!(snowglobe(home.path(), &again).status.success());
    let growth = |folder: &str| fs::read(home.path().join(folder).join("growth.csv")).unwrap();
    assert_eq!(growth("o"), growth("p"));
}

#[test]
fn frost_says_when_ice_cannot_get_there() {
    let home = home();
    small_region(home.path());
    let starved = [
        "frost",
        "--cells",
        "region.csv",
        "--start",
        "0,0",
        "--beta",
        "0.05",
        "--gamma",
        "0",
        "--width",
        "64",
    ];
    assert!(snowglobe(home.path(), &starved).status.success());
    let summary: serde_json::Value =
        serde_json::from_slice(&fs::read(home.path().join("out/frost/summary.json")).unwrap()).unwrap();
    assert!(summary["t_sim"].is_null() && summary["t_sim_interpolated"].is_null());
    assert_eq!(summary["ended"], "unreachable");
}

#[test]
fn frost_refuses_what_makes_no_sense_in_one_line() {
    let home = home();
    small_region(home.path());
    fs::write(home.path().join("empty.csv"), "q,r\n").unwrap();
    fs::write(home.path().join("bad.csv"), "q,r\n1,x\n").unwrap();
    fs::write(home.path().join("bad.svg"), "<svg><path d='M0 0").unwrap();
    fs::write(home.path().join("bad.png"), "not a picture").unwrap();
    fs::write(home.path().join("blank.svg"), "<svg xmlns='http://www.w3.org/2000/svg'/>").unwrap();
    let cells = |more: &[&str], words: &[&str]| {
        let base = ["frost", "--cells", "region.csv", "--out", "o"];
        refused(home.path(), &[&base[..], more].concat(), words);
    };
    let start = ["--start", "0,0", "--beta"];
    cells(&["--beta", "0.3"], &["--start"]);
    cells(&["--start", "0,0"], &["--beta"]);
    cells(&["--start", "9,9", "--beta", "0.3"], &["9,9", "outside"]);
    cells(&["--start", "1;2", "--beta", "0.3"], &["--start", "Q,R"]);
    for (flag, value, word) in [
        ("--alpha", "2.5", "stable"),
        ("--alpha", "-1", "alpha"),
        ("--gamma", "NaN", "gamma"),
        ("--gamma", "1e300", "gamma"),
        ("--threshold", "1.5", "threshold"),
        ("--steps-per-frame", "0", "steps_per_frame"),
        ("--share", "0", "share"),
        ("--share", "inf", "share"),
        ("--reading", "wrong", "as-printed"),
        ("--reading", "redraw=wrong", "frame|step|cell"),
        ("--edge", "soft", "held"),
        ("--redraw", "never", "step"),
        ("--ring-touching-ice", "one", "zero"),
        ("--share-of", "some", "border"),
        ("--width", "3", "--width"),
        ("--frames", "99999999", "--frames"),
        ("--target", "-5", "--target"),
        ("--target", "NaN", "--target"),
    ] {
        cells(&[&start[..], &["0.3", flag, value]].concat(), &[word]);
    }
    cells(&[&start[..], &["nan"]].concat(), &["beta"]);
    cells(&[&start[..], &["-0.1"]].concat(), &["beta"]);
    for (file, word) in [("empty.csv", "empty"), ("bad.csv", "line 2"), ("none.csv", "none.csv")] {
        refused(home.path(), &["frost", "--cells", file, "--start", "0,0", "--beta", "0.3"], &[word]);
    }
    for (file, word) in
        [("bad.svg", "bad.svg"), ("bad.png", "bad.png"), ("blank.svg", "paint"), ("a.gif", ".svg")]
    {
        refused(home.path(), &["frost", "--sketch", file, "--beta", "0.3"], &[word]);
    }
    refused(home.path(), &["frost", "--beta", "0.3"], &["--cells"]);
    let leaf = ours("experiments/data/leaf.svg");
    for spacing in ["0", "-1", "NaN", "1e-9"] {
        refused(
            home.path(),
            &["frost", "--sketch", &leaf, "--beta", "0.3", "--spacing", spacing],
            &["spacing"],
        );
    }
    assert!(!home.path().join("o").exists() && !home.path().join("out").exists(), "nothing half-written");
}

#[test]
fn a_printed_table_is_examined() {
    let home = home();
    let table = home.path().join("table.csv");
    fs::write(&table, "step,x,y\n0,0.25,162\n1,0.294132,135\n2,0.316651,124\n3,0.315713,127\n").unwrap();
    let asked =
        ["forensics", "--iterates", "table.csv", "--target", "130", "--eta", "1e-6", "--random", "20"];
    let output = snowglobe(home.path(), &asked);
    let told = text(&output.stdout);
    assert!(output.status.success(), "{}", text(&output.stderr));
    let line = |start: &str, y: &str| {
        let found = told.lines().find(|line| line.starts_with(start) && line.contains(y));
        found.unwrap_or_else(|| panic!("{start} {y}: {told}")).to_owned()
    };
    assert!(line("secant  ", " exact ").contains("refuted   1 2"));
    assert!(line("secant  ", " ceiling ").contains("survives"));
    assert!(line("secant  ", " floor ").contains("refuted   2"));
    assert_eq!(fs::read_dir(home.path()).unwrap().count(), 1, "nothing is written without --out");

    let written = snowglobe(home.path(), &[&asked[..], &["--out", "o"]].concat());
    assert!(written.status.success() && text(&written.stdout).starts_with(&told));
    assert_eq!(
        columns(&home.path().join("o/hypotheses.csv")),
        "rule,y_printed,verdict,refuted_by,random,free,left"
    );
    assert_eq!(columns(&home.path().join("o/implied.csv")), "step,from,to,slope_used");

    let with = |more: &[&'static str]| [&["forensics", "--iterates", "table.csv"][..], more].concat();
    refused(home.path(), &with(&["--eta", "fast"]), &["--eta", "fast", "no decimal"]);
    refused(home.path(), &with(&["--eta", "0"]), &["step length", "above 0"]);
    refused(home.path(), &with(&["--eta", "1", "--x-printed", "up"]), &["--x-printed", "ceiling"]);
    refused(home.path(), &with(&["--eta", "1", "--h-least", "1"]), &["--h-least", "--h-most"]);
    refused(home.path(), &with(&["--eta", "1", "--y-most", "0"]), &["--y-most", "1500"]);
    refused(home.path(), &["forensics", "--iterates", "none.csv", "--eta", "1"], &["none.csv"]);
    fs::write(&table, "a,y\n1,2\n").unwrap();
    refused(home.path(), &with(&["--eta", "1"]), &["no column `x`"]);
    fs::write(&table, "x,y\n1,2\n2,\n3,4\n").unwrap();
    refused(home.path(), &with(&["--eta", "1"]), &["table.csv", "no decimal"]);
}

#[test]
fn cavity_writes_what_it_promises_and_refuses_a_step_with_both_numbers() {
    let home = home();
    for (scheme, rows) in [("staggered", 19), ("collocated", 18)] {
        let run = [
            "cavity",
            "--reynolds",
            "100",
            "--cells",
            "17",
            "--dt",
            "0.01",
            "--time",
            "0.5",
            "--scheme",
            scheme,
            "--lid",
            "2",
            "--out",
            scheme,
        ];
        let output = snowglobe(home.path(), &run);
        assert!(output.status.success(), "{}", text(&output.stderr));
        let folder = home.path().join(scheme);
        for (file, head, last) in [("u.csv", "y,u", "1,2"), ("v.csv", "x,v", "1,0")] {
            let csv = text(&fs::read(folder.join(file)).unwrap());
            let lines: Vec<&str> = csv.lines().collect();
            assert_eq!((lines[0], lines[1], lines[lines.len() - 1]), (head, "0,0", last));
            assert_eq!(lines.len(), 1 + rows, "{scheme} {file}");
            let places: Vec<f64> =
                lines[1..].iter().map(|line| line.split(',').next().unwrap().parse().unwrap()).collect();
            assert!(places.windows(2).all(|pair| pair[0] < pair[1]), "{places:?}");
        }
        let summary: serde_json::Value =
            serde_json::from_slice(&fs::read(folder.join("summary.json")).unwrap()).unwrap();
        assert_eq!(summary["steps"], 50);
        assert!(summary["kinetic_energy"].as_f64().unwrap() > 0.0 && summary["max_divergence"].is_number());
    }
    let unstable = ["cavity", "--reynolds", "100", "--cells", "32", "--dt", "0.1"];
    refused(home.path(), &unstable, &["--dt", "0.1 s is unstable", "up to 0.01"]);
    refused(home.path(), &["cavity", "--reynolds", "-5"], &["--reynolds", "-5", "accepted"]);
    refused(home.path(), &["cavity", "--reynolds", "5", "--scheme", "x"], &["staggered, collocated"]);
}

#[test]
fn tree_writes_what_it_promises() {
    let home = home();
    let run = ["tree", "--wind", "7", "--seconds", "0.2", "--every", "0.05", "--frames", "10", "--out", "a"];
    let output = snowglobe(home.path(), &run);
    assert!(output.status.success(), "{}", text(&output.stderr));
    let motion = text(&fs::read(home.path().join("a/motion.csv")).unwrap());
    let lines: Vec<&str> = motion.lines().collect();
    assert_eq!(lines[0], "t,tip_x,tip_y,mean_bend_deg,centroid_x,centroid_y");
    assert_eq!((lines.len(), lines[1]), (6, "0,0,0,0,0,0"));
    assert!(home.path().join("a/frame-00002.svg").is_file());
    assert!(fs::read(home.path().join("a/tree.glb")).unwrap().starts_with(b"glTF"));
    assert!(fs::read(home.path().join("a/tree.ply")).unwrap().starts_with(b"ply\n"));
    // The same wind from the right, in a file, on the tree of a file that mirrors the paper's.
    fs::write(home.path().join("gust.csv"), "t,u\n0,-7\n9,-7\n").unwrap();
    let rules = "axiom = 'F'\nsteps = 2\nangle = 20\nproductions = [{ from = 'F', to = 'F[-F]F[+F][F]' }]\n";
    fs::write(home.path().join("mirrored.toml"), rules).unwrap();
    let mirrored = [
        "tree",
        "--wind",
        "-1",
        "--inflow",
        "gust.csv",
        "--rules",
        "mirrored.toml",
        "--seconds",
        "0.2",
        "--every",
        "0.05",
        "--frames",
        "0",
        "--out",
        "b",
    ];
    let output = snowglobe(home.path(), &mirrored);
    assert!(output.status.success(), "{}", text(&output.stderr));
    let back = text(&fs::read(home.path().join("b/motion.csv")).unwrap());
    let numbers = |line: &str| line.split(',').map(|cell| cell.parse().unwrap()).collect::<Vec<f64>>();
    for (there, back) in lines[1..].iter().zip(back.lines().skip(1)) {
        let (a, b) = (numbers(there), numbers(back));
        assert_eq!([a[0], a[1], a[2], a[3], a[4], a[5]], [b[0], -b[1], b[2], b[3], -b[4], b[5]]);
    }
}

#[test]
fn tree_refuses_what_makes_no_sense_in_one_line() {
    let home = home();
    fs::write(home.path().join("bad.toml"), "axiom = 'F'\nsteps = 2\nangel = 20\nproductions = []\n")
        .unwrap();
    fs::write(home.path().join("bad.csv"), "t,u\n0,5\n0,6\n").unwrap();
    fs::write(home.path().join("head.csv"), "time,u\n0,5\n").unwrap();
    for (arguments, words) in [
        (&["--dt", "0.02"][..], &["0.02 s is unstable", "at most 0.006"][..]),
        (&["--set", "x"], &["paper, physical, literal"]),
        (&["--reading", "x"], &["position=as-printed|times-dt"]),
        (&["--reading", "as-printed"], &["several places"]),
        (&["--rules", "bad.toml"], &["bad.toml", "angel"]),
        (&["--rules", "none.toml"], &["cannot read"]),
        (&["--inflow", "bad.csv"], &["line 3", "must rise"]),
        (&["--inflow", "head.csv"], &["`t,u` is accepted"]),
        (&["--height", "-1"], &["height is -1"]),
        (&["--damping", "1.5"], &["damping is 1.5"]),
        (&["--tree", "x"], &["derived or merged"]),
        (&["--seconds", "nan"], &["--seconds"]),
    ] {
        let arguments: Vec<&str> = std::iter::once("tree").chain(arguments.iter().copied()).collect();
        refused(home.path(), &arguments, words);
    }
    assert!(!home.path().join("out").exists());
}
