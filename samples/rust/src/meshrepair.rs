// SPDX-License-Identifier: MIT
//! A thin, safe layer over meshrepair.h: what this sample needs of it.
use std::ffi::{c_char, c_int, CStr, CString};
use std::ptr;

#[repr(C)]
struct RawMesh {
    _private: [u8; 0],
}
#[repr(C)]
struct RawOptions {
    _private: [u8; 0],
}
#[repr(C)]
struct RawResult {
    _private: [u8; 0],
}

#[link(name = "meshrepair")]
extern "C" {
    fn meshrepair_last_error() -> *const c_char;
    fn meshrepair_mesh_new(
        vertices: *const f64,
        vertex_count: usize,
        triangles: *const u32,
        triangle_count: usize,
    ) -> *mut RawMesh;
    fn meshrepair_mesh_free(mesh: *mut RawMesh);
    fn meshrepair_mesh_vertex_count(mesh: *const RawMesh) -> usize;
    fn meshrepair_mesh_triangle_count(mesh: *const RawMesh) -> usize;
    fn meshrepair_mesh_vertices(mesh: *const RawMesh) -> *const f64;
    fn meshrepair_mesh_triangles(mesh: *const RawMesh) -> *const u32;
    fn meshrepair_options_new() -> *mut RawOptions;
    fn meshrepair_options_free(options: *mut RawOptions);
    fn meshrepair_options_set(
        options: *mut RawOptions,
        name: *const c_char,
        value: *const c_char,
    ) -> c_int;
    fn meshrepair_repair(mesh: *const RawMesh, options: *const RawOptions) -> *mut RawResult;
    fn meshrepair_result_free(result: *mut RawResult);
    fn meshrepair_result_code(result: *const RawResult) -> c_int;
    fn meshrepair_result_error(result: *const RawResult) -> *const c_char;
    fn meshrepair_result_take_mesh(result: *mut RawResult) -> *mut RawMesh;
}

/// Why a call failed: an exit code of the programs, and a line for people.
#[derive(Debug)]
pub struct Error {
    pub code: i32,
    pub message: String,
}

/// # Safety
/// `text` ends with a zero.
unsafe fn text_of(text: *const c_char) -> String {
    CStr::from_ptr(text).to_string_lossy().into_owned()
}

fn last_error(code: i32) -> Error {
    Error {
        code,
        message: unsafe { text_of(meshrepair_last_error()) },
    }
}

fn c_string(text: &str) -> Result<CString, Error> {
    CString::new(text).map_err(|_| Error {
        code: 2,
        message: format!("{text:?} has a zero in it"),
    })
}

/// Points and triangles, as the library holds them.
pub struct Mesh(*mut RawMesh);

impl Mesh {
    pub fn new(vertices: &[[f64; 3]], triangles: &[[u32; 3]]) -> Result<Mesh, Error> {
        let mesh = unsafe {
            meshrepair_mesh_new(
                vertices.as_ptr().cast(),
                vertices.len(),
                triangles.as_ptr().cast(),
                triangles.len(),
            )
        };
        if mesh.is_null() {
            Err(last_error(2))
        } else {
            Ok(Mesh(mesh))
        }
    }

    pub fn vertices(&self) -> &[[f64; 3]] {
        unsafe {
            slice_of(
                meshrepair_mesh_vertices(self.0).cast(),
                meshrepair_mesh_vertex_count(self.0),
            )
        }
    }

    pub fn triangles(&self) -> &[[u32; 3]] {
        unsafe {
            slice_of(
                meshrepair_mesh_triangles(self.0).cast(),
                meshrepair_mesh_triangle_count(self.0),
            )
        }
    }

    /// The boundary of a solid, or why there is none. Options are those of the program meshrepair; a
    /// flag has no value.
    pub fn repaired(&self, options: &[(&str, Option<&str>)]) -> Result<Mesh, Error> {
        let options = Options::new(options)?;
        let result = CallResult(unsafe { meshrepair_repair(self.0, options.0) });
        match unsafe { meshrepair_result_code(result.0) } {
            0 => Ok(Mesh(unsafe { meshrepair_result_take_mesh(result.0) })),
            code => Err(Error {
                code,
                message: unsafe { text_of(meshrepair_result_error(result.0)) },
            }),
        }
    }
}

/// # Safety
/// `first` is null, or points to so many.
unsafe fn slice_of<'a, T>(first: *const T, count: usize) -> &'a [T] {
    if count == 0 {
        &[]
    } else {
        std::slice::from_raw_parts(first, count)
    }
}

impl Drop for Mesh {
    fn drop(&mut self) {
        unsafe { meshrepair_mesh_free(self.0) }
    }
}

struct CallResult(*mut RawResult);

impl Drop for CallResult {
    fn drop(&mut self) {
        unsafe { meshrepair_result_free(self.0) }
    }
}

struct Options(*mut RawOptions);

impl Options {
    fn new(all: &[(&str, Option<&str>)]) -> Result<Options, Error> {
        let options = Options(unsafe { meshrepair_options_new() });
        for (name, value) in all {
            let name = c_string(name)?;
            let value = value.map(c_string).transpose()?;
            let value = value.as_ref().map_or(ptr::null(), |text| text.as_ptr());
            let code = unsafe { meshrepair_options_set(options.0, name.as_ptr(), value) };
            if code != 0 {
                return Err(last_error(code));
            }
        }
        Ok(options)
    }
}

impl Drop for Options {
    fn drop(&mut self) {
        unsafe { meshrepair_options_free(self.0) }
    }
}
