// SPDX-License-Identifier: MIT
//! Repairs a cube that lacks a side.
mod meshrepair;

use meshrepair::{Error, Mesh};

fn open_cube() -> Result<Mesh, Error> {
    let vertices: Vec<[f64; 3]> = (0..8)
        .map(|i| [i & 1, i >> 1 & 1, i >> 2].map(f64::from))
        .collect();
    let triangles = [
        [0, 2, 1],
        [1, 2, 3],
        [0, 1, 4],
        [1, 5, 4],
        [0, 4, 2],
        [2, 4, 6],
        [1, 3, 5],
        [3, 7, 5],
        [2, 6, 3],
        [3, 6, 7],
    ];
    Mesh::new(&vertices, &triangles)
}

fn volume(mesh: &Mesh) -> f64 {
    let corner = |index: u32| mesh.vertices()[index as usize];
    let six_times: f64 = mesh
        .triangles()
        .iter()
        .map(|&[a, b, c]| {
            let ([ax, ay, az], [bx, by, bz], [cx, cy, cz]) = (corner(a), corner(b), corner(c));
            ax * (by * cz - bz * cy) + ay * (bz * cx - bx * cz) + az * (bx * cy - by * cx)
        })
        .sum();
    six_times / 6.0
}

fn main() {
    let solid =
        open_cube().and_then(|cube| cube.repaired(&[("for", Some("print")), ("always", None)]));
    match solid {
        Ok(solid) => println!(
            "{} triangles, volume {}",
            solid.triangles().len(),
            volume(&solid)
        ),
        Err(error) => {
            eprintln!("repair_mesh: {}", error.message);
            std::process::exit(error.code);
        }
    }
}
