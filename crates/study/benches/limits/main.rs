//! What this processor allows at most: one line for each loop.
//!
//! `cargo bench -p trigon-study --bench limits`

#![expect(clippy::print_stdout, reason = "a table is what this is for")]

mod kernels;
mod limit;
mod shaded;

use limit::Limit;

const REPETITIONS: usize = 33;

fn main() {
    println!("limit,median,least,most,unit");
    for limit in Limit::ALL {
        let [median, least, most] = limit.rates(REPETITIONS);
        println!("{},{median:.2},{least:.2},{most:.2},{}", limit.name(), limit.unit());
    }
}
