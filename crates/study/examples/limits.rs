//! What this processor allows at most: one line for each loop.
//!
//! `cargo run --release -p trigon-study --example limits`

#![expect(clippy::print_stdout, reason = "a table is what this is for")]

use trigon_study::limits::Limit;

const REPETITIONS: usize = 33;

fn main() {
    println!("limit,median,least,most,unit");
    for limit in Limit::ALL {
        let [median, least, most] = limit.rates(REPETITIONS);
        println!("{},{median:.2},{least:.2},{most:.2},{}", limit.name(), limit.unit());
    }
}
