//! Matrices and quaternions of poses.

use serde_json::Value;
use trigon_math::{DAffine3, DMat3, DQuat, DVec3};

/// A matrix by rows, 4 × 4 or 3 × 4.
pub(super) fn affine(value: &Value) -> Result<DAffine3, String> {
    let rows: Option<Vec<[f64; 4]>> = value.as_array().and_then(|rows| rows.iter().map(numbers).collect());
    let rows = rows
        .filter(|rows| matches!(rows.len(), 3 | 4))
        .ok_or("its pose is not a matrix of 4 by 4, or 3 by 4, numbers")?;
    if rows.get(3).is_some_and(|last| *last != [0.0, 0.0, 0.0, 1.0]) {
        return Err(
            "the last row of its pose is not 0 0 0 1; transpose it if it is stored by columns".to_owned()
        );
    }
    let column = |index: usize| DVec3::new(rows[0][index], rows[1][index], rows[2][index]);
    Ok(DAffine3 { matrix3: DMat3::from_cols(column(0), column(1), column(2)), translation: column(3) })
}

/// Four numbers of a row.
fn numbers(row: &Value) -> Option<[f64; 4]> {
    let numbers: Vec<f64> = row.as_array()?.iter().map(Value::as_f64).collect::<Option<_>>()?;
    numbers.try_into().ok()
}

/// A quaternion of length 1. One that has it but for rounding stays as it is.
pub(super) fn unit(quaternion: DQuat) -> Result<DQuat, String> {
    let excess = (quaternion.length() - 1.0).abs();
    match excess {
        _ if excess < 4.0 * f64::EPSILON => Ok(quaternion),
        // Written with few digits.
        _ if excess <= 1e-3 => Ok(quaternion.normalize()),
        _ => Err(format!("its rotation is a quaternion of length {}, not 1", quaternion.length())),
    }
}
