//! One mesh, in a process of its own: one that crashes, or takes too long, ends alone.

use std::fs;
use std::io::Read;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, ExitStatus, Stdio};
use std::thread;
use std::time::{Duration, Instant};

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use roundel::{Error, Result};

use super::Arguments;
use super::meshes::MeshFile;
use super::row::{Outcome, Row};
use crate::interrupt;
use crate::output::io_error;

/// Width and height of pictures.
const PICTURE: &str = "200x150";
/// How often it is looked whether a process has ended.
const PAUSE: Duration = Duration::from_millis(10);

/// How meshes are run.
pub(super) struct Runner {
    program: PathBuf,
    flags: Vec<String>,
    jobs: usize,
    /// For each mesh.
    threads: usize,
    limit: Duration,
    quads_to: Option<PathBuf>,
    /// The folder of pictures, which is removed at the end.
    scratch: PathBuf,
}

impl Runner {
    /// # Errors
    /// If a folder cannot be made.
    pub fn new(arguments: &Arguments) -> Result<Self> {
        let failed = |path: &Path, reason| io_error(&path.to_string_lossy(), &reason);
        let program =
            std::env::current_exe().map_err(|reason| failed(Path::new("roundel"), reason))?;
        let cores = thread::available_parallelism().map_or(1, usize::from);
        let jobs = if arguments.jobs == 0 {
            cores
        } else {
            arguments.jobs
        };
        let scratch = std::env::temp_dir().join(format!("roundel-census-{}", std::process::id()));
        fs::create_dir_all(&scratch).map_err(|reason| failed(&scratch, reason))?;
        if let Some(folder) = &arguments.quads_to {
            fs::create_dir_all(folder).map_err(|reason| failed(folder, reason))?;
        }
        Ok(Runner {
            program,
            flags: arguments.flags.clone(),
            jobs,
            threads: (cores / jobs).max(1),
            limit: Duration::from_secs_f64(arguments.kill_after),
            quads_to: arguments.quads_to.clone(),
            scratch,
        })
    }

    /// The flags of every mesh.
    pub fn flags(&self) -> &[String] {
        &self.flags
    }

    /// How many meshes run at a time.
    pub fn jobs(&self) -> usize {
        self.jobs
    }

    /// The file that quads of a mesh are written to.
    fn quads_file(&self, name: &str) -> Option<PathBuf> {
        let folder = self.quads_to.as_ref()?;
        Some(folder.join(format!("{}.obj", file_name(name))))
    }

    /// Whether a row was made of this file, by this version with these flags, and its quads are where they are to be.
    pub fn is_current(&self, mesh: &MeshFile, row: &Row) -> bool {
        let is_written = |file: PathBuf| row.figures.quads.is_none() || file.exists();
        row.is_of(mesh, &self.flags) && self.quads_file(&mesh.name).is_none_or(is_written)
    }

    /// Runs a mesh.
    pub fn row(&self, mesh: &MeshFile) -> Row {
        let picture = self.scratch.join(format!("{}.png", file_name(&mesh.name)));
        let started = Instant::now();
        let ended = self.run(mesh, &picture);
        let seconds = started.elapsed().as_secs_f64();
        let mut row = Row::new(mesh, &self.flags, Outcome::Crashed, seconds);
        match ended {
            Ok(Some((status, told))) => {
                let told = serde_json::from_slice(&told).unwrap_or_default();
                row.fill(&told, status);
                let png = fs::read(&picture).ok();
                row.figures.thumbnail = png.map(|png| STANDARD.encode(png));
            }
            Ok(None) => row.outcome = Outcome::Stopped,
            Err(error) => row.figures.message = Some(error.to_string()),
        }
        let _ = fs::remove_file(&picture);
        row
    }

    /// The end of the process and what it printed; none if it took too long.
    fn run(&self, mesh: &MeshFile, picture: &Path) -> Result<Option<(ExitStatus, Vec<u8>)>> {
        let mut command = Command::new(&self.program);
        command.arg("quad").arg(&mesh.path);
        command.args(["--json", "--measure-distance", "--picture-size", PICTURE]);
        command.arg("--picture").arg(picture);
        if let Some(file) = self.quads_file(&mesh.name) {
            command.arg("-o").arg(file);
        }
        let is_threads = |flag: &String| flag == "--threads" || flag.starts_with("--threads=");
        if !self.flags.iter().any(is_threads) {
            command.arg(format!("--threads={}", self.threads));
        }
        command.args(&self.flags);
        command
            .stdin(Stdio::null())
            .stdout(Stdio::piped())
            .stderr(Stdio::null());
        let failed = |reason| io_error(&mesh.name, &reason);
        let mut child = command.spawn().map_err(failed)?;
        // Read beside: a full pipe would stop the process.
        let stdout = child.stdout.take();
        let reader = thread::spawn(move || {
            let mut told = Vec::new();
            let read = stdout.map(|mut stdout| stdout.read_to_end(&mut told));
            read.transpose().map(|_| told)
        });
        let status = self.wait(&mut child).map_err(failed)?;
        let told = reader.join().map_err(|_| Error::Io {
            message: format!("{}: what was printed cannot be read", mesh.name),
        })?;
        Ok(status.zip(told.ok()))
    }

    /// Waits until a process has ended. One that is seen after the limit took too long, ended or not.
    fn wait(&self, child: &mut Child) -> std::io::Result<Option<ExitStatus>> {
        let started = Instant::now();
        loop {
            let left = self.limit.saturating_sub(started.elapsed());
            if left.is_zero() || interrupt::was_asked() {
                child.kill()?;
                child.wait()?;
                return Ok(None);
            }
            if let Some(status) = child.try_wait()? {
                return Ok(Some(status));
            }
            thread::sleep(PAUSE.min(left));
        }
    }
}

impl Drop for Runner {
    fn drop(&mut self) {
        // Nothing is lost if it stays.
        let _ = fs::remove_dir_all(&self.scratch);
    }
}

/// The name of a mesh as that of a file.
fn file_name(name: &str) -> String {
    name.replace('/', "__")
}
