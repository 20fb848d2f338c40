//! The command `adslam`.

use std::process::ExitCode;

use adslam_cli::Command;
use clap::Parser;

#[derive(Debug, Parser)]
#[command(
    name = "adslam",
    version,
    about = "Active SLAM in deforming 3D environments",
    long_about = "Plans the motion of a robot that maps an object which moves and deforms, in \
                  simulation, and filters recorded logs.\n\nExit codes: 0 all went well, 1 the \
                  work failed, 2 the input cannot be used, 130 interrupted.",
    after_help = "Try:\n  adslam run scenarios/polygon.toml --planner combined --seed 1 --out run\n  \
                  adslam tables configs/paper.toml --out results\n  \
                  adslam check scenarios/*.toml configs/*.toml"
)]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

fn main() -> ExitCode {
    let interrupt = adslam_cli::stop_on_ctrl_c();
    adslam_cli::exit_code(Arguments::parse().command.execute(interrupt))
}
