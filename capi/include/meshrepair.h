// SPDX-License-Identifier: MIT
/* meshrepair for C, and for whatever can call C: turns any triangle mesh into the boundary of a
 * solid.
 *
 *   meshrepair_result *read = meshrepair_read("broken.stl", NULL);
 *   meshrepair_result *repaired = meshrepair_repair(meshrepair_result_mesh(read), NULL);
 *   if (meshrepair_result_code(repaired) == MESHREPAIR_DONE) ...
 *
 * Meshes, options and results are handles. What meshrepair_..._new() and the calls that work return
 * is the caller's, who frees it; a pointer that is got from a handle is the handle's, and is good
 * as long as the handle is neither freed nor changed. Each function takes NULL for a handle: as a
 * mesh of nothing, as options that are not set, and as the result of a call for which memory ran
 * out.
 *
 * Nothing is thrown, printed, or kept between calls. Functions may be called from any thread; one
 * handle may be read by several threads at a time, or changed by one. A process that was forked
 * calls these functions before the fork or after it, not both.
 *
 * Strings are UTF-8 and end with a zero; names of files are bytes as the system has them. Numbers
 * in them have a point, whatever the locale. */
#ifndef MESHREPAIR_H
#define MESHREPAIR_H

#include <stddef.h>
#include <stdint.h>

#if defined(__GNUC__)
#define MESHREPAIR_API __attribute__((visibility("default")))
#else
#define MESHREPAIR_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* What became of a call: the exit codes of the programs. */
typedef enum meshrepair_code {
  MESHREPAIR_DONE = 0,          /* a mesh that came out holds every guarantee */
  MESHREPAIR_NOT_CERTIFIED = 1, /* one came out, but lacks some; or one that was checked is none */
  MESHREPAIR_USAGE = 2,         /* an argument or option makes no sense */
  MESHREPAIR_INPUT = 3,         /* the file cannot be read */
  MESHREPAIR_LIMIT = 4,         /* a limit on time or size was reached, or memory ran out */
  MESHREPAIR_NO_SOLID = 5,      /* the input encloses nothing */
  MESHREPAIR_OUTPUT = 6,        /* the file cannot be written */
  MESHREPAIR_INTERNAL = 70,     /* a bug of this library */
  MESHREPAIR_INTERRUPTED = 130  /* the progress function asked to stop */
} meshrepair_code;

/* In place of a number where there is none: of a corner without a value, of a triangle that has no
 * name, of one that lies in no triangle of the input. */
#define MESHREPAIR_NONE UINT32_MAX

/* Points, triangles, and what these carry. */
typedef struct meshrepair_mesh meshrepair_mesh;
/* How a call is to work. */
typedef struct meshrepair_options meshrepair_options;
/* What came of a call. */
typedef struct meshrepair_result meshrepair_result;

/* Of the library that runs: "0.1.0". */
MESHREPAIR_API const char* meshrepair_version(void);

/* Why the last function on this thread failed that returned a code or a handle; one line, "" if it
 * did not fail. Good until the next call on this thread. */
MESHREPAIR_API const char* meshrepair_last_error(void);

/* ---- Meshes ---- */

/* A copy of `vertex_count` points, x, y, z each, and of `triangle_count` triangles, three numbers
 * of points each, from 0 on, counterclockwise seen from outside. NULL where one names a point that
 * is not there, or memory runs out. Triangles at points that are not finite are left out of
 * repairs, which the report says. */
MESHREPAIR_API meshrepair_mesh* meshrepair_mesh_new(const double* vertices, size_t vertex_count,
                                                    const uint32_t* triangles,
                                                    size_t triangle_count);
MESHREPAIR_API void meshrepair_mesh_free(meshrepair_mesh* mesh);

MESHREPAIR_API size_t meshrepair_mesh_vertex_count(const meshrepair_mesh* mesh);
MESHREPAIR_API size_t meshrepair_mesh_triangle_count(const meshrepair_mesh* mesh);
/* Three for each; the memory of the mesh. NULL if there are none. */
MESHREPAIR_API const double* meshrepair_mesh_vertices(const meshrepair_mesh* mesh);
MESHREPAIR_API const uint32_t* meshrepair_mesh_triangles(const meshrepair_mesh* mesh);

/* What corners carry. An attribute has values of `components` numbers, and of each corner the
 * number of its value: of corner k of triangle t at 3 t + k. Its name is "texture" (2 or 3
 * numbers), "normal" (3), "tangent" (4), "colour" (3 or 4, from 0 to 1) or "skin_weights" (8: four
 * numbers of joints, and their weights; or more such), for further ones of a kind with "_1" and so
 * on behind it, in the order in which they are added, or any other (1 to 16).
 * Attributes of kinds come first, in this order. */
MESHREPAIR_API size_t meshrepair_mesh_attribute_count(const meshrepair_mesh* mesh);
/* NULL or 0 where there is no such attribute; so for those that follow. */
MESHREPAIR_API const char* meshrepair_mesh_attribute_name(const meshrepair_mesh* mesh,
                                                          size_t index);
MESHREPAIR_API size_t meshrepair_mesh_attribute_components(const meshrepair_mesh* mesh,
                                                           size_t index);
MESHREPAIR_API size_t meshrepair_mesh_attribute_value_count(const meshrepair_mesh* mesh,
                                                            size_t index);
MESHREPAIR_API const double* meshrepair_mesh_attribute_values(const meshrepair_mesh* mesh,
                                                              size_t index);
MESHREPAIR_API const uint32_t* meshrepair_mesh_attribute_corners(const meshrepair_mesh* mesh,
                                                                 size_t index);
/* Adds a copy; `corners` has three numbers for each triangle, MESHREPAIR_NONE for no value.
 * MESHREPAIR_DONE, or what is wrong; then the mesh is as before. */
MESHREPAIR_API meshrepair_code meshrepair_mesh_add_attribute(meshrepair_mesh* mesh,
                                                             const char* name, size_t components,
                                                             const double* values,
                                                             size_t value_count,
                                                             const uint32_t* corners);

/* What triangles are called: by which of these `label` says. Materials keep how they look if they
 * come from a file. */
typedef enum meshrepair_label {
  MESHREPAIR_MATERIAL = 0,
  MESHREPAIR_GROUP = 1,
  MESHREPAIR_OBJECT = 2,
  MESHREPAIR_SMOOTHING = 3
} meshrepair_label;

MESHREPAIR_API size_t meshrepair_mesh_label_count(const meshrepair_mesh* mesh, int label);
MESHREPAIR_API const char* meshrepair_mesh_label_name(const meshrepair_mesh* mesh, int label,
                                                      size_t index);
/* Of each triangle the number of its name; NULL where none has one. */
MESHREPAIR_API const uint32_t* meshrepair_mesh_labels(const meshrepair_mesh* mesh, int label);
/* Copies; replaces what is there. `labels` has a number for each triangle; NULL without
 * names removes them. As above. */
MESHREPAIR_API meshrepair_code meshrepair_mesh_set_labels(meshrepair_mesh* mesh, int label,
                                                          const char* const* names,
                                                          size_t name_count,
                                                          const uint32_t* labels);

/* ---- Options ---- */

/* None set; NULL where memory runs out. */
MESHREPAIR_API meshrepair_options* meshrepair_options_new(void);
MESHREPAIR_API void meshrepair_options_free(meshrepair_options* options);
/* One of the long options of the program that does the same, without "--": "for" and "print". The
 * value is NULL for those that take none. What was set before under this name is replaced. The call
 * that works says whether it knows the option. */
MESHREPAIR_API meshrepair_code meshrepair_options_set(meshrepair_options* options, const char* name,
                                                      const char* value);

/* Told the stage and its share, 0 to 1, some twenty times a second on the thread that called; what
 * is not 0 asks the call to stop, which it does soon, with MESHREPAIR_INTERRUPTED. It must return.
 */
typedef int (*meshrepair_progress)(void* data, const char* stage, double share);
MESHREPAIR_API void meshrepair_options_set_progress(meshrepair_options* options,
                                                    meshrepair_progress told, void* data);

/* ---- Calls that work ---- */
/* Each returns a result, which says whether it went well. Meshes that go in stay as they are. */

/* Options of the program meshrepair, but those about files. The mesh is the repaired one. */
MESHREPAIR_API meshrepair_result* meshrepair_repair(const meshrepair_mesh* mesh,
                                                    const meshrepair_options* options);
/* The same from points, x, y, z each; `normals` has as many, or is NULL. */
MESHREPAIR_API meshrepair_result* meshrepair_repair_points(const double* points,
                                                           const double* normals,
                                                           size_t point_count,
                                                           const meshrepair_options* options);
/* All options of the program meshrepair; there is no mesh. */
MESHREPAIR_API meshrepair_result* meshrepair_repair_file(const char* input, const char* output,
                                                         const meshrepair_options* options);
/* Options of bspbool, of which "op" is to be set: "union", "intersection", "difference", "xor". */
MESHREPAIR_API meshrepair_result* meshrepair_boolean(const meshrepair_mesh* const* meshes,
                                                     size_t mesh_count,
                                                     const meshrepair_options* options);
/* Options of meshcheck: "weld", "places", "openings". MESHREPAIR_DONE if the mesh is the boundary
 * of a solid, else MESHREPAIR_NOT_CERTIFIED. There are marks, and no mesh. */
MESHREPAIR_API meshrepair_result* meshrepair_check(const meshrepair_mesh* mesh,
                                                   const meshrepair_options* options);
/* All options of meshcheck, those for further files, too. The same code; there are no marks. */
MESHREPAIR_API meshrepair_result* meshrepair_check_file(const char* input,
                                                        const meshrepair_options* options);
/* Options of meshdist. The report says the distances. */
MESHREPAIR_API meshrepair_result* meshrepair_distance(const meshrepair_mesh* mesh,
                                                      const meshrepair_mesh* other,
                                                      const meshrepair_options* options);
/* The mesh as the file has it, with what it carries. Points of a scan are a mesh without triangles,
 * which remembers that it is one: meshrepair_repair() makes a solid of it. It carries nothing, and
 * the other calls refuse it. */
MESHREPAIR_API meshrepair_result* meshrepair_read(const char* path,
                                                  const meshrepair_options* options);
/* The option "format" says what is written where the name of the file does not.
 * Warnings say what the format cannot hold. The file is there whole, or not at all. */
MESHREPAIR_API meshrepair_result* meshrepair_write(const char* path, const meshrepair_mesh* mesh,
                                                   const meshrepair_options* options);

/* ---- Results ---- */

MESHREPAIR_API void meshrepair_result_free(meshrepair_result* result);
MESHREPAIR_API meshrepair_code meshrepair_result_code(const meshrepair_result* result);
/* Why the code is another than MESHREPAIR_DONE, in a line; "" otherwise. */
MESHREPAIR_API const char* meshrepair_result_error(const meshrepair_result* result);
/* JSON: the report of the program that does the same; "" where nothing ran. */
MESHREPAIR_API const char* meshrepair_result_report(const meshrepair_result* result);
MESHREPAIR_API size_t meshrepair_result_warning_count(const meshrepair_result* result);
MESHREPAIR_API const char* meshrepair_result_warning(const meshrepair_result* result, size_t index);

/* The result's own; NULL where none came out. */
MESHREPAIR_API const meshrepair_mesh* meshrepair_result_mesh(const meshrepair_result* result);
/* The same as the caller's, who frees it; the result is without it then. */
MESHREPAIR_API meshrepair_mesh* meshrepair_result_take_mesh(meshrepair_result* result);
/* Of each triangle of a repaired mesh the triangle of the input that it lies in; those of several
 * meshes count through. NULL where there is no mesh. Stays when the mesh is taken. */
MESHREPAIR_API const uint32_t* meshrepair_result_sources(const meshrepair_result* result);

/* Of a check: of each triangle a bit for each defect that it has; NULL where there is none. */
MESHREPAIR_API const uint16_t* meshrepair_result_marks(const meshrepair_result* result);
/* Of bit 0, 1, ...: "open_edges" and so on, as in the report; NULL where there is none. */
MESHREPAIR_API const char* meshrepair_defect_name(size_t bit);

#ifdef __cplusplus
}
#endif

#endif
