//! Writes `docs/primitives.md` from the declarations of the primitives.

fn main() {
    print!("{}", vpl::primitives::reference());
}
