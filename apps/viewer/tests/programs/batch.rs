//! `trigon-viewer batch`: jobs, shards, receipts, resuming after kills, verification.

use std::collections::BTreeMap;
use std::io::{BufRead, BufReader};

use serde_json::{Value, json};

use super::*;

/// Two cameras before the corner.
const RIG: &str = r#"{"width": 40, "height": 30, "vertical_fov": 40, "cameras": [
    {"name": "left", "position": [0.3, 0.5, 6], "rotation": [0, 0, 0, 1]},
    {"name": "right", "position": [0.8, 0.5, 6], "rotation": [0, 0, 0, 1]}]}"#;

/// A folder with a list of jobs.
fn folder_with(jobs: &[Value]) -> Folder {
    let folder = Folder::new();
    folder.write("rig.json", RIG);
    let lines: Vec<String> = jobs.iter().map(Value::to_string).collect();
    folder.write("jobs.jsonl", &lines.join("\n"));
    folder
}

/// A job with two views and two outputs: six files.
fn rig_job(name: &str) -> Value {
    json!({"input": "corner.obj", "cameras": "rig.json", "output": format!("out/{name}/{{camera}}.png"),
        "outputs": ["depth", "object-ids"], "samples": 2})
}

/// A job of one image.
fn small_job(name: &str, color: &str) -> Value {
    json!({"input": "corner.obj", "output": format!("out/{name}.png"), "resolution": "50,40", "color": color})
}

/// The lines of JSON that a batch writes.
fn told(folder: &Folder, flags: &str, code: i32) -> Vec<Value> {
    let output = folder.run(&format!("batch jobs.jsonl --json {flags}"));
    assert_eq!(output.status.code(), Some(code), "{flags}: {output:?}");
    let lines = String::from_utf8(output.stdout).expect("UTF-8");
    lines.lines().map(|line| serde_json::from_str(line).expect("JSON")).collect()
}

/// Lines and outcomes.
fn outcomes(told: &[Value]) -> Vec<String> {
    told.iter()
        .map(|line| format!("{} {}", line["line"], line["outcome"].as_str().expect("a word")))
        .collect()
}

/// All files of a folder and what they hold, but for those that a killed process left unfinished.
fn files(folder: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    let mut found = BTreeMap::new();
    for entry in fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("an entry").path();
        if path.is_dir() {
            found.extend(files(&path));
        } else if path.extension().is_none_or(|ending| ending != "part") {
            found.insert(path.clone(), fs::read(&path).expect("readable"));
        }
    }
    found
}

#[test]
fn a_job_is_drawn_as_its_command_line_draws_it() {
    let folder = folder_with(&[rig_job("a"), small_job("red", "#f00")]);
    let lines = told(&folder, "", 0);
    assert_eq!(outcomes(&lines), ["1 drawn", "2 drawn"], "{lines:?}");
    folder.said("corner.obj --resolution 50,40 --color #f00 --output red.png", 0);
    folder.said(
        "corner.obj --cameras=rig.json --output {camera}.png --outputs=depth,object-ids --samples=2",
        0,
    );
    let names = [
        "a/left.png",
        "a/left.depth.npy",
        "a/left.object-ids.npy",
        "a/right.png",
        "a/right.depth.npy",
        "a/right.object-ids.npy",
    ];
    for name in names.iter().chain(&["red.png"]) {
        let [batch, alone] = [format!("out/{name}"), name.trim_start_matches("a/").to_owned()]
            .map(|path| fs::read(folder.path(&path)).expect("written"));
        assert!(batch == alone, "{name} is not what the command draws");
    }
    // The receipt names what was read and written, and tells of nodes and cameras.
    let path = lines[0]["receipt"].as_str().expect("a path");
    let receipt: Value =
        serde_json::from_slice(&fs::read(folder.path(path)).expect("written")).expect("JSON");
    let listed = |list: &str| -> Vec<String> {
        let files = receipt[list].as_array().expect("a list").iter();
        files.map(|file| file["file"].as_str().expect("a name").to_owned()).collect()
    };
    assert_eq!(listed("read"), ["corner.mtl", "corner.obj", "rig.json"], "{receipt}");
    assert_eq!(listed("written"), names.map(|name| format!("out/{name}")), "{receipt}");
    assert_eq!(
        receipt["written"][0]["bytes"],
        fs::read(folder.path("out/a/left.png")).expect("written").len()
    );
    let facts = &receipt["facts"][0];
    assert_eq!(facts["views"][1]["camera"]["position"][0], 0.8, "{facts}");
    assert_eq!(facts["node_list"][0]["name"], "corner", "{facts}");
    let text = receipt.to_string();
    assert!(!text.contains("_seconds"), "a receipt is the same each time: {text}");
}

#[test]
fn shards_divide_a_list_and_resuming_draws_what_is_missing_or_changed() {
    let folder = folder_with(&[small_job("a", "red"), rig_job("b"), small_job("c", "blue")]);
    assert_eq!(outcomes(&told(&folder, "--shard 0/2", 0)), ["1 drawn", "3 drawn"]);
    assert_eq!(outcomes(&told(&folder, "--shard 1/2 --resume --threads=1", 0)), ["2 drawn"]);
    let drawn = files(&folder.path("out"));
    let all = ["1 present", "2 present", "3 present"];
    assert_eq!(outcomes(&told(&folder, "--resume", 0)), all);

    // A file that was changed or lost.
    fs::write(folder.path("out/b/left.depth.npy"), "broken").expect("written");
    fs::remove_file(folder.path("out/c.png")).expect("removed");
    assert_eq!(outcomes(&told(&folder, "--resume", 0)), ["1 present", "2 drawn", "3 drawn"]);
    assert!(files(&folder.path("out")) == drawn, "the same bytes as before");

    // What only one of them reads.
    folder.write("rig.json", &RIG.replace("0.8", "0.9"));
    assert_eq!(outcomes(&told(&folder, "--resume", 0)), ["1 present", "2 drawn", "3 present"]);
    assert!(files(&folder.path("out")) != drawn, "another camera");
    // A setting: the job is another one.
    folder.write(
        "jobs.jsonl",
        &[small_job("a", "red"), small_job("c", "green")].map(|job| job.to_string()).join("\n"),
    );
    assert_eq!(outcomes(&told(&folder, "--resume", 0)), ["1 present", "2 drawn"]);
}

#[test]
fn a_job_that_fails_stops_no_other_and_is_drawn_again() {
    let missing = json!({"input": "late.obj", "output": "out/late.png", "resolution": "40,30"});
    let wrong = json!({"input": "corner.obj", "output": "out/wrong.png", "samples": 99});
    let folder = folder_with(&[missing, wrong, small_job("c", "blue")]);
    let lines = told(&folder, "", 2);
    assert_eq!(outcomes(&lines), ["1 failed", "2 failed", "3 drawn"]);
    assert_eq!((&lines[0]["exit_code"], &lines[1]["exit_code"]), (&json!(1), &json!(2)), "{lines:?}");
    assert!(lines[1]["failure"].as_str().expect("a reason").contains("--samples"), "{lines:?}");
    let said = folder.said("batch jobs.jsonl --resume", 2);
    assert!(said.contains("late.obj: "), "why: {said}");
    assert!(said.contains("jobs.jsonl, line 2: "), "where: {said}");
    assert!(said.contains("3 jobs, 0 drawn, 1 there already, 2 failed"), "{said}");
    folder.write("late.obj", CORNER);
    assert_eq!(outcomes(&told(&folder, "--resume", 2)), ["1 drawn", "2 failed", "3 present"]);
}

#[test]
fn what_was_drawn_is_verified_by_drawing_it_again() {
    let folder = folder_with(&[small_job("a", "red"), rig_job("b")]);
    let said = folder.said("batch jobs.jsonl --verify", 1);
    assert!(said.contains("draw the job first"), "{said}");
    told(&folder, "", 0);
    let before = files(&folder.path(""));
    assert_eq!(outcomes(&told(&folder, "--verify --threads=1", 0)), ["1 verified", "2 verified"]);
    assert!(files(&folder.path("")) == before, "it writes nothing");

    // As if another machine had drawn other bytes: a digit of the digest of the ids.
    let receipt =
        before.keys().find(|path| path.ends_with(receipt_name(&folder, 1))).expect("a receipt").clone();
    let mut told_wrong: Value = serde_json::from_slice(&before[&receipt]).expect("JSON");
    told_wrong["written"][5]["sha256"] = json!("0".repeat(64));
    fs::rename(folder.path("out"), folder.path("elsewhere")).expect("renamed");
    fs::write(&receipt, told_wrong.to_string()).expect("written");
    let said = folder.said("batch jobs.jsonl --verify", 3);
    assert!(
        said.contains("out/b/right.object-ids.npy: drawn again, it is not the same (1 of 6 files differ)"),
        "{said}"
    );
    assert!(!folder.path("out").exists(), "it writes nothing");

    // A file that was changed after it was drawn, and a model that was.
    fs::write(&receipt, &before[&receipt]).expect("written");
    fs::rename(folder.path("elsewhere"), folder.path("out")).expect("renamed");
    fs::write(folder.path("out/a.png"), "other").expect("written");
    let said = folder.said("batch jobs.jsonl --verify --shard=0/2", 3);
    assert!(said.contains("out/a.png: is not what was drawn"), "{said}");
    folder.write("corner.mtl", "newmtl red\nKd 0 1 0\n");
    let said = folder.said("batch jobs.jsonl --verify --shard=1/2", 3);
    assert!(said.contains("corner.mtl: is not the file that the images were drawn from"), "{said}");
}

/// The receipt of a job, relative to the folder.
fn receipt_name(folder: &Folder, job: usize) -> String {
    told(folder, "--resume", 0)[job]["receipt"].as_str().expect("a path").to_owned()
}

/// Four processes are killed at whatever they do after their first job, three times over.
#[test]
fn killed_processes_lose_nothing_that_is_not_drawn_again() {
    let jobs: Vec<Value> = (0..16).map(|number| small_job(&format!("{number:02}"), "red")).collect();
    let undisturbed = folder_with(&jobs);
    told(&undisturbed, "", 0);
    let folder = folder_with(&jobs);
    for _ in 0..3 {
        let started: Vec<_> = (0..4)
            .map(|shard| {
                let flags = format!("batch jobs.jsonl --json --resume --shard={shard}/4 --threads=1");
                folder
                    .command(&flags)
                    .stdout(Stdio::piped())
                    .stderr(Stdio::null())
                    .spawn()
                    .expect("it starts")
            })
            .collect();
        for mut process in started {
            let mut line = String::new();
            let stdout = process.stdout.take().expect("piped");
            BufReader::new(stdout).read_line(&mut line).expect("the first job");
            process.kill().expect("killed");
            process.wait().expect("it ended");
        }
    }
    let lines = told(&folder, "--resume", 0);
    assert_eq!(lines.len(), jobs.len(), "{lines:?}");
    let [disturbed, calm] = [&folder, &undisturbed].map(|folder| {
        let base = folder.path("");
        files(&base)
            .into_iter()
            .map(|(path, bytes)| (path.strip_prefix(&base).expect("in it").to_owned(), bytes))
            .collect::<BTreeMap<_, _>>()
    });
    assert_eq!(disturbed.keys().collect::<Vec<_>>(), calm.keys().collect::<Vec<_>>(), "the same files");
    assert!(disturbed == calm, "images and receipts are the same bytes");
}

#[test]
fn jobs_cannot_replace_each_others_images() {
    let folder = folder_with(&[small_job("a", "red"), small_job("a", "blue")]);
    let said = folder.said("batch jobs.jsonl", 2);
    assert!(said.contains("jobs.jsonl, line 2: it writes out/a.png, as line 1 does"), "{said}");
    assert!(!folder.path("out").exists(), "nothing is drawn");
    // Names of cameras are known only when they are read.
    let by_camera = |color: &str| json!({"input": "corner.obj", "cameras": "rig.json", "output": "{camera}.png", "color": color});
    let folder = folder_with(&[by_camera("red"), by_camera("blue")]);
    let lines = told(&folder, "", 2);
    assert_eq!(outcomes(&lines), ["1 drawn", "2 failed"], "{lines:?}");
    folder.said("corner.obj --cameras=rig.json --output alone_{camera}.png --color=red", 0);
    assert!(image(&folder.path("left.png")) == image(&folder.path("alone_left.png")), "the first one's");
    assert_eq!(
        outcomes(&told(&folder, "--resume", 2)),
        ["1 present", "2 failed"],
        "also when the first is there"
    );
}

/// The user's configuration would make other images on other machines.
#[test]
fn a_job_does_not_read_the_users_configuration() {
    let folder = folder_with(&[small_job("a", "red")]);
    fs::create_dir_all(folder.path("home/trigon")).expect("a folder");
    folder.write("home/trigon/config.json", r#"[{"options": {"no-background": true}}]"#);
    let status = folder.command("batch jobs.jsonl").env("XDG_CONFIG_HOME", folder.path("home")).status();
    assert!(status.expect("it runs").success(), "drawn");
    let drawn = image(&folder.path("out/a.png"));
    assert!(drawn.rgba.chunks(4).all(|pixel| pixel[3] == 255), "it has its background");
    // One that the job names is read.
    folder.write("mine.json", r#"[{"options": {"no-background": true}}]"#);
    let mut named = small_job("b", "red");
    named["config"] = json!("mine.json");
    folder.write("jobs.jsonl", &named.to_string());
    let lines = told(&folder, "", 0);
    assert!(image(&folder.path("out/b.png")).rgba.chunks(4).any(|pixel| pixel[3] == 0), "transparent");
    let receipt =
        fs::read_to_string(folder.path(lines[0]["receipt"].as_str().expect("a path"))).expect("written");
    assert!(receipt.contains("mine.json"), "it is an input: {receipt}");
    // But not for what a batch cannot repeat.
    folder.write("mine.json", r#"[{"options": {"time-budget": "5ms"}}]"#);
    let said = folder.said("batch jobs.jsonl", 2);
    assert!(said.contains("the same each time"), "{said}");
}

#[test]
fn mistakes_on_the_command_line_are_named() {
    let folder = folder_with(&[]);
    for (flags, code, word) in [
        ("batch", 2, "JOBS.jsonl"),
        ("batch missing.jsonl", 1, "missing.jsonl: cannot be read"),
        ("batch -", 2, "--receipts"),
        ("batch jobs.jsonl --shard 2/2", 2, "the last is 1/2"),
        ("batch jobs.jsonl --resume --verify", 2, "cannot be used with"),
        ("batch corner.obj", 2, "corner.obj, line 1: it is not JSON"),
    ] {
        let said = folder.said(flags, code);
        assert!(said.contains(word), "{flags}: {said}");
    }
    let said = folder.said("batch jobs.jsonl", 0);
    assert!(said.contains("0 jobs, 0 drawn"), "an empty list: {said}");
    let mut command = folder.command("batch - --receipts=r --verbose=quiet");
    let mut child = command.stdin(Stdio::piped()).spawn().expect("it starts");
    std::io::Write::write_all(
        child.stdin.as_mut().expect("piped"),
        small_job("a", "red").to_string().as_bytes(),
    )
    .expect("it reads");
    assert!(child.wait().expect("it ends").success(), "a list from standard input");
    assert!(folder.path("out/a.png").exists() && folder.path("r").exists(), "drawn, with its receipt");
}
