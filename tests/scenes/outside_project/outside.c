// SPDX-License-Identifier: LGPL-2.1-or-later
// Prints the status of a solution and its creepage coefficient C11, then what wrong input gives, each with
// the message.
#include <tread/half_space.h>

#include <stdio.h>

int main(void)
{
  // Hertz's radius of the patch, cbrt(3 F R/(4 E*)) with R = 0.5 m and E* = 112 GPa; a 16th of it is an
  // element.
  const double            a = 6.943915e-3, g = 84e9;
  tread_half_space_case   problem = {.curvature_x  = 1.,
                                     .curvature_y  = 1.,
                                     .normal_force = 1e5,
                                     .friction     = 0.3,
                                     .young        = 210e9,
                                     .poisson      = 0.25,
                                     .creepage     = -1e-5,
                                     .element_x    = a / 16.,
                                     .element_y    = a / 16.};
  tread_half_space_answer answer;
  tread_half_space       *solver = tread_half_space_create();
  int                     status = tread_half_space_version() == TREAD_HALF_SPACE_VERSION
                                     ? tread_half_space_solve(solver, &problem, &answer)
                                     : 9;
  tread_half_space_grid   grid;
  tread_half_space_get_grid(solver, &grid);
  if (grid.element_x != a / 16. || grid.n_x < 32)
    status = 8;
  printf("%d %.6f [%s]\n", status, answer.longitudinal_force / (g * a * a * 1e-5),
         tread_half_space_message(solver));
  problem.friction = -1.;
  status           = tread_half_space_solve(solver, &problem, &answer);
  printf("%d %d [%s]\n", status, answer.longitudinal_force != answer.longitudinal_force,
         tread_half_space_message(solver));
  tread_half_space_destroy(solver);
  return 0;
}
