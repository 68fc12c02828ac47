//! Makes a baseline of what the benchmarks print as JSON: kernels and their
//! instructions, in alphabetical order.

use std::collections::BTreeMap;
use std::io::{self, BufRead};

use serde_json::Value;

fn main() -> io::Result<()> {
    let mut counts = BTreeMap::new();
    for line in io::stdin().lock().lines() {
        let Ok(summary) = serde_json::from_str::<Value>(&line?) else {
            continue;
        };
        if let (Some(kernel), Some(count)) = (summary["function_name"].as_str(), instructions(&summary)) {
            counts.insert(kernel.to_owned(), count);
        }
    }
    println!("{}", serde_json::to_string_pretty(&counts)?);
    Ok(())
}

/// The first count named `Ir`, wherever it is; where it is compared with an older
/// run, the new one comes first.
fn instructions(value: &Value) -> Option<u64> {
    match value {
        Value::Object(fields) => fields
            .get("Ir")
            .and_then(first_number)
            .or_else(|| fields.values().find_map(instructions)),
        Value::Array(items) => items.iter().find_map(instructions),
        _ => None,
    }
}

fn first_number(value: &Value) -> Option<u64> {
    match value {
        Value::Number(number) => number.as_u64(),
        Value::Object(fields) => fields.values().find_map(first_number),
        Value::Array(items) => items.iter().find_map(first_number),
        _ => None,
    }
}
