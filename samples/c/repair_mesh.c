// SPDX-License-Identifier: MIT
/* Repairs a mesh that is in memory, and says how far it is: repair_mesh IN OUT */
#include <stdio.h>

#include <meshrepair.h>

/* Returns 0 to go on. */
static int tell(void *data, const char *stage, double share) {
  (void)data;
  fprintf(stderr, "%s %.0f %%\n", stage, 100 * share);
  return 0;
}

static int complain(const meshrepair_result *result) {
  fprintf(stderr, "repair_mesh: %s\n", meshrepair_result_error(result));
  return (int)meshrepair_result_code(result);
}

static int repair(const meshrepair_mesh *mesh, const char *output) {
  meshrepair_options *options = meshrepair_options_new();
  meshrepair_options_set(options, "for", "print");
  meshrepair_options_set_progress(options, tell, NULL);
  meshrepair_result *repaired = meshrepair_repair(mesh, options);
  meshrepair_options_free(options);

  int code = (int)meshrepair_result_code(repaired);
  if (code == MESHREPAIR_DONE) {
    const meshrepair_mesh *solid = meshrepair_result_mesh(repaired);
    printf("%zu vertices, %zu triangles, certified\n", meshrepair_mesh_vertex_count(solid),
           meshrepair_mesh_triangle_count(solid));
    meshrepair_result *written = meshrepair_write(output, solid, NULL);
    if (meshrepair_result_code(written) != MESHREPAIR_DONE) code = complain(written);
    meshrepair_result_free(written);
  } else {
    complain(repaired);
  }
  meshrepair_result_free(repaired);
  return code;
}

int main(int argc, char **argv) {
  if (argc != 3) {
    fprintf(stderr, "usage: repair_mesh IN OUT\n");
    return MESHREPAIR_USAGE;
  }
  meshrepair_result *read = meshrepair_read(argv[1], NULL);
  const int code = meshrepair_result_code(read) == MESHREPAIR_DONE
                       ? repair(meshrepair_result_mesh(read), argv[2])
                       : complain(read);
  meshrepair_result_free(read);
  return code;
}
