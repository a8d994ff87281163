// SPDX-License-Identifier: MIT
/* Uses the installed C interface: repairs a cube, which changes nothing about it. */
#include <stdio.h>

#include <meshrepair.h>

int main(int argc, char **argv) {
  if (argc != 2) return 2;
  meshrepair_result *read = meshrepair_read(argv[1], NULL);
  meshrepair_result *repaired = meshrepair_repair(meshrepair_result_mesh(read), NULL);
  const int code = (int)meshrepair_result_code(repaired);
  printf("%s: %zu triangles, code %d\n", meshrepair_version(),
         meshrepair_mesh_triangle_count(meshrepair_result_mesh(repaired)), code);
  meshrepair_result_free(repaired);
  meshrepair_result_free(read);
  return code;
}
