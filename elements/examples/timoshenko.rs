// The beam of timoshenko.c in Rust, as the formulation timoshenko_rs: strains [m] and stresses; derivatives of
// the strains are computed by differences. The first part is elements/element.h in Rust, of which this element
// needs only these members; the second part is the element, to be replaced.
//   rustc -O --crate-type cdylib elements/examples/timoshenko.rs -o timoshenko_rs.so
//   beamwork element-test --element ./timoshenko_rs.so
#![allow(dead_code)]
use std::os::raw::{c_char, c_int, c_uint, c_void};
use std::ptr::null;

const ABI: c_uint = 4;
const OK: c_int = 0;
const LEAVES_J: c_uint = 1;
const DOUBLY_SYMMETRIC: c_uint = 1;
const HALF_TURN: c_uint = 32;
const HARINGX: c_uint = 2;
const SHEAR: c_uint = 2;
const GEOMETRIC: c_uint = 256;
const LARGE: c_uint = 512;
const MASS: c_uint = 1024;
const ROTARY_INERTIA: c_uint = 2048;

#[repr(C)]
pub struct Section { // the first members of section
    young: f64, shear_modulus: f64, density: f64, area: f64, iy: f64, iz: f64, it: f64, iw: f64,
    ys: f64, zs: f64, ip: f64, wagner_y: f64, wagner_z: f64, wagner_torque: f64, d: [f64; 9], f: [f64; 9],
}
#[repr(C)]
pub struct Request { // the first members of element_request
    section: *const Section, length: f64, features: c_uint, options: *const f64,
}
#[repr(C)]
pub struct Node { r: [f64; 3], u: [f64; 3], rotation: [f64; 9], a: f64, scalar: [f64; 6] }
#[repr(C)]
pub struct Strains { e: *mut f64, j: *mut f64, s: *const f64, h: *mut f64, history: *const f64 }
#[repr(C)]
pub struct Stresses { energy: *mut f64, sigma: *mut f64, c: *mut f64, residual: *mut f64, memory: *mut f64, history: *const f64, state: *const f64 }

type Unused = *const c_void; // a function or an array that is not given
#[repr(C)]
pub struct ElementType {
    abi: c_uint, size: usize,
    name: *const c_char, summary: *const c_char, source: *const c_char, family: *const c_char,
    offers: c_uint,
    data_size: extern "C" fn(&Request) -> usize,
    prepare: extern "C" fn(&Request, &mut Element, *mut c_char) -> c_int,
    strain: extern "C" fn(&Element, &[Node; 2], &Strains),
    stress: extern "C" fn(&Element, &[f64; M], *const f64, &Stresses) -> c_int,
    force: Unused,
    leaves: c_uint, limits: c_uint, lacks: c_uint, lacks_by: Unused, shear_theories: c_uint,
    own_theory: Unused, order: Unused, options: [Unused; 5], judged: Unused, nodes: Unused,
    strains: extern "C" fn(*const f64) -> c_int,
    inner: Unused, memory: Unused, update: Unused, rest: Unused, geometric: Unused, inertia: Unused,
    strain_many: Unused, stress_many: Unused, force_many: Unused, constants: Unused, trouble: Unused,
    lanes: c_int, equations_many: Unused, spreads: c_int, tension: Unused, misprint: Unused, along: Unused,
    mass_of_field: Unused, unstressed: Unused, history: Unused, begin: Unused, commit: Unused,
    places: Unused, damping: Unused, line: Unused, scalars: Unused, held: c_uint,
}
unsafe impl Sync for ElementType {}

const M: usize = 6; // strains

#[repr(C)]
pub struct Element { length: f64, stiffness: [f64; M] } // [m], [N/m]

extern "C" fn data_size(_: &Request) -> usize { std::mem::size_of::<Element>() }

extern "C" fn strains(_: *const f64) -> c_int { M as c_int }

extern "C" fn prepare(request: &Request, out: &mut Element, _fault: *mut c_char) -> c_int {
    let (c, l) = (unsafe { &*request.section }, request.length);
    // Transverse: shear if requested, and the bending that a uniform curvature lacks.
    let shear = if request.features & SHEAR != 0 { l / c.shear_modulus } else { 0.0 };
    let across = |flexibility: f64, second_moment: f64| 1.0 / (shear * flexibility + l.powi(3) / (12.0 * c.young * second_moment));
    *out = Element {
        length: l,
        stiffness: [c.young * c.area / l, across(c.f[0], c.iz), across(c.f[4], c.iy),
                    c.shear_modulus * c.it / l.powi(3), c.young * c.iy / l.powi(3), c.young * c.iz / l.powi(3)],
    };
    OK
}

fn dot(a: &[f64], b: &[f64]) -> f64 { a.iter().zip(b).map(|(x, y)| x * y).sum() }

// The vector v in the axes of a node, which are the columns of R.
fn turned_back(rotation: &[f64; 9], v: &[f64; 3]) -> [f64; 3] {
    std::array::from_fn(|i| (0..3).map(|k| rotation[3 * k + i] * v[k]).sum())
}

// The rotation vector from a to b, in the axes of a; shorter than pi.
fn between(a: &[f64; 9], b: &[f64; 9]) -> [f64; 3] {
    let t = |i: usize, j: usize| -> f64 { (0..3).map(|k| a[3 * k + i] * b[3 * k + j]).sum() };
    let axis = [(t(2, 1) - t(1, 2)) / 2.0, (t(0, 2) - t(2, 0)) / 2.0, (t(1, 0) - t(0, 1)) / 2.0];
    let sine = dot(&axis, &axis).sqrt();
    let part = if sine > 0.0 { sine.atan2((t(0, 0) + t(1, 1) + t(2, 2) - 1.0) / 2.0) / sine } else { 1.0 };
    axis.map(|v| v * part)
}

extern "C" fn strain(of: &Element, x: &[Node; 2], out: &Strains) {
    if out.e.is_null() {
        return;
    }
    let chord = std::array::from_fn(|i| x[1].r[i] - x[0].r[i]);
    let psi = between(&x[0].rotation, &x[1].rotation);
    let (p, q) = (turned_back(&x[0].rotation, &chord), turned_back(&x[1].rotation, &chord));
    // Normal to psi, the mean of p and q is that of the axes half way times c; along psi, all are equal.
    let square = dot(&psi, &psi);
    let c = (square.sqrt() / 2.0).cos();
    let k = if square > 0.0 { (1.0 - 1.0 / c) / square } else { 0.0 };
    let e = unsafe { std::slice::from_raw_parts_mut(out.e, M) };
    for i in 0..3 {
        e[i] = (p[i] + q[i]) / (2.0 * c) + k * dot(&psi, &p) * psi[i];
        e[3 + i] = of.length * psi[i];
    }
    e[0] -= of.length;
}

extern "C" fn stress(of: &Element, e: &[f64; M], _inner: *const f64, out: &Stresses) -> c_int {
    let sigma: [f64; M] = std::array::from_fn(|i| of.stiffness[i] * e[i]);
    unsafe {
        if let Some(energy) = out.energy.as_mut() {
            *energy = dot(&sigma, e) / 2.0;
        }
        if !out.sigma.is_null() {
            *(out.sigma as *mut [f64; M]) = sigma;
        }
        for k in 0..if out.c.is_null() { 0 } else { M * M } {
            *out.c.add(k) = if k % (M + 1) == 0 { of.stiffness[k / M] } else { 0.0 };
        }
        if let Some(residual) = out.residual.as_mut() {
            *residual = 0.0;
        }
    }
    OK
}

#[no_mangle]
pub static beamwork_element: ElementType = ElementType {
    abi: ABI, size: std::mem::size_of::<ElementType>(),
    name: b"timoshenko_rs\0".as_ptr().cast(),
    summary: b"two nodes, one integration point, flexible in shear, no warping, in Rust\0".as_ptr().cast(),
    source: b"Reissner, J. Appl. Math. Phys. 32 (1981), one point of integration\0".as_ptr().cast(),
    family: b"example\0".as_ptr().cast(),
    offers: SHEAR | GEOMETRIC | LARGE | MASS | ROTARY_INERTIA,
    data_size, prepare, strain, stress, force: null(),
    leaves: LEAVES_J, limits: DOUBLY_SYMMETRIC | HALF_TURN, lacks: 0, lacks_by: null(), shear_theories: HARINGX,
    own_theory: null(), order: null(), options: [null(); 5], judged: null(), nodes: null(), strains,
    inner: null(), memory: null(), update: null(), rest: null(), geometric: null(), inertia: null(),
    strain_many: null(), stress_many: null(), force_many: null(), constants: null(), trouble: null(),
    lanes: 0, equations_many: null(), spreads: 0, tension: null(), misprint: null(), along: null(),
    mass_of_field: null(), unstressed: null(), history: null(), begin: null(), commit: null(),
    places: null(), damping: null(), line: null(), scalars: null(), held: 0,
};
