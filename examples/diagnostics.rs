//! Writes `docs/diagnostics/README.md` from the codes.

fn main() {
    print!("{}", vpl::lang::index_of_codes());
}
