//! Free-form curves and surfaces, of this version and of 2.11.

use super::row::Case::{File, Lines};
use super::row::{Row, left, refused};

pub(super) fn rows() -> Vec<Row> {
    const SURFACE: &str = "a.obj, line 8: curves and surfaces are not drawn; convert them to polygons";
    const PART: &str = "part of a curve or surface, each of which has a warning";
    let drawn = |statement: &'static str, case: &'static str| {
        left(statement, Lines(case), "it would have to be cut into polygons").says(SURFACE)
    };
    let part = |statement: &'static str, case: &'static str| left(statement, Lines(case), PART);
    vec![
        drawn("curv u0 u1 v1 v2 …", "curv 0 1 1 2 3 4"),
        drawn("surf s0 s1 t0 t1 v1 v2 …", "surf 0 1 0 1 1 2 3 4"),
        drawn("bzp v1 … v16", "bzp 1 2 3 4 1 2 3 4 1 2 3 4 1 2 3 4"),
        drawn("bsp v1 … v16", "bsp 1 2 3 4 1 2 3 4 1 2 3 4 1 2 3 4"),
        drawn("cdc v1 v2 v3 v4 …", "cdc 1 2 3 4"),
        drawn("cdp v1 … v16", "cdp 1 2 3 4 1 2 3 4 1 2 3 4 1 2 3 4"),
        left("surf, twice and with its parts", Lines("cstype bezier\ndeg 1 1\nsurf 0 1 0 1 1 2 4 3\nparm u 0 1\nparm v 0 1\nend\nsurf 0 1 0 1 1 2 4 3\nend"), "one warning for all")
            .says("a.obj, line 10: curves and surfaces are not drawn … and 1 more; convert them to polygons"),
        refused(
            "a file with nothing but surfaces",
            File("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\ncstype bezier\ndeg 1 1\n> surf 0 1 0 1 1 2 4 3\nparm u 0 1\nparm v 0 1\nend"),
            "a.obj: there is nothing to draw but curves and surfaces, which are not drawn; convert them to polygons",
        ),
        part("curv2 vp1 vp2 …", "curv2 1 2"),
        part("cstype rat type", "cstype rat bspline"),
        part("deg degu degv", "deg 3 3"),
        part("bmat u …", "bmat u 1 0 0 1"),
        part("step stepu stepv", "step 1 1"),
        part("parm u p1 p2 …", "parm u 0 0 1 1"),
        part("trim u0 u1 curv2d …", "trim 0 1 1"),
        part("hole u0 u1 curv2d …", "hole 0 1 1"),
        part("scrv u0 u1 curv2d …", "scrv 0 1 1"),
        part("sp vp1 …", "sp 1"),
        part("end", "end"),
        part("con surf1 q0 q1 curv2d1 surf2 …", "con 1 0 1 1 2 0 1 1"),
        part("ctech technique resolution", "ctech cparm 4"),
        part("stech technique resolution", "stech cparma 4 4"),
        part("res useg vseg", "res 4 4"),
    ]
}
