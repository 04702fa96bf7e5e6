/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef tread_half_space_h
#define tread_half_space_h

/* Steady rolling contact of two elastic half-spaces, the model of Kalker's CONTACT, as a C library
 * (libtread_half_space) without mesh, MPI or deal.II: for programs that solve many contacts, such as
 * multi-body programs and makers of creep-force tables.
 *
 * Axes: x in rolling direction (leading edge at +x), y lateral, z up into the wheel. All forces and tractions
 * are those on the wheel, exerted by the rail: a positive longitudinal force drives. Creepages and spin are
 * the rigid slip of the wheel over the rail divided by the speed, w_x = creepage - spin y,   w_y =
 * lateral_creepage + spin x, so that a driving wheel has a negative creepage. SI units. Both bodies have the
 * same elastic constants.
 *
 * All functions can be called in several threads at once; one solver belongs to one thread at a time. No
 * function throws or prints. */

#include <stddef.h>

#if defined(__GNUC__)
#define TREAD_HALF_SPACE_API __attribute__((visibility("default")))
#else
#define TREAD_HALF_SPACE_API
#endif

#ifdef __cplusplus
extern "C"
{
#endif

/* Grows when a struct below changes; compare it with tread_half_space_version(). */
#define TREAD_HALF_SPACE_VERSION 1

  /* Zeros mean what the comment says after "0:", so that a struct set to zero needs only what has no such
   * comment. */
  typedef struct
  {
    double curvature_x,
      curvature_y;         /* A, B > 0 of the gap A x^2 + B y^2 [1/m]; not read with a gap of its own */
    double normal_force;   /* Fn > 0 [N] */
    double friction;       /* Coulomb's coefficient [-], >= 0 */
    double young, poisson; /* of both bodies [Pa], [-] */
    double creepage, lateral_creepage; /* [-] */
    double spin;                       /* [rad/m] */
    double element_x,
      element_y;    /* edges of the elements [m]; 0: a 28th of the semi-axis in rolling direction, a tenth
                     of that across, for forces within 0.5 % of friction times load */
    int slip_order; /* 1: slip as in CONTACT; 2, 0: of second order, more accurate on the same elements */
    /* Any other gap of the undeformed surfaces [m], n_y rows of n_x elements, x fastest, that hold the patch.
     * 0: none. The first element has its centre at (x_first, y_first). element_x and element_y must be given.
     */
    const double *gap;
    unsigned int  n_x, n_y;
    double        x_first, y_first; /* [m] */
  } tread_half_space_case;

  /* What became of a case. */
  enum
  {
    TREAD_HALF_SPACE_SOLVED        = 0,
    TREAD_HALF_SPACE_WRONG_INPUT   = 1,
    TREAD_HALF_SPACE_NOT_SOLVED    = 2, /* the iteration did not converge */
    TREAD_HALF_SPACE_OUT_OF_MEMORY = 3
  };

  typedef struct
  {
    int    status;     /* of the above; anything but solved leaves NaN in all that follows */
    int    iterations; /* Newton steps of the tangential problem */
    double longitudinal_force, lateral_force; /* Fx, Fy on the wheel [N] */
    double spin_moment;                       /* of the shear about z, on the wheel [N m] */
    double max_pressure;   /* of an element [Pa]; of slip order 2 without a gap of its own Hertz's maximum */
    double adhesion_share; /* elements in adhesion over those in contact [-] */
    double area;     /* of the elements in contact, or, where the pressure is Hertz's, of the ellipse [m^2] */
    double approach; /* of distant points of the bodies [m] */
    double frictional_work; /* for each metre that the wheel rolls [J/m], >= 0 */
  } tread_half_space_answer;

  /* Keeps the fields of the case that it solved last. */
  typedef struct tread_half_space tread_half_space;

  TREAD_HALF_SPACE_API int tread_half_space_version(void);

  /* 0 if there is no memory. */
  TREAD_HALF_SPACE_API tread_half_space *tread_half_space_create(void);
  TREAD_HALF_SPACE_API void              tread_half_space_destroy(tread_half_space *solver);

  /* Returns the status. */
  TREAD_HALF_SPACE_API int tread_half_space_solve(tread_half_space            *solver,
                                                  const tread_half_space_case *problem,
                                                  tread_half_space_answer     *answer);

  /* The way that a wheel rolls, one element in rolling direction in each of n steps. */
  typedef struct
  {
    size_t        n;
    const double *heights;      /* of the rail's surface, alike across [m]; 0: level. The first belongs to the
                                 * element under the wheel (x = 0) in the first step; before and behind the way
                                 * it is as high as at its ends. */
    const double *normal_force; /* in each step, > 0 [N]; 0: the case's */
    const double *creepage;     /* longitudinal, in each step [-]; 0: the case's */
  } tread_half_space_way;

  /* Transient rolling over an uneven way, from steady rolling in the first step. The case must have a gap,
   * with an element centre at x = 0, and friction. What is not 0 is filled: approach [m] and
   * longitudinal_force on the wheel [N] with n values, work of friction per area of the rail [J/m^2] with n_y
   * rows of n elements of the way; elements near both ends have not been passed by all of the patch. The
   * solver has no fields and no grid afterwards. Returns the status. */
  TREAD_HALF_SPACE_API int tread_half_space_roll(tread_half_space            *solver,
                                                 const tread_half_space_case *problem,
                                                 const tread_half_space_way  *way,
                                                 double                      *approach,
                                                 double                      *longitudinal_force,
                                                 double                      *work);

  /* What was wrong with the last case, "" if nothing; until the next call with this solver. */
  TREAD_HALF_SPACE_API const char *tread_half_space_message(const tread_half_space *solver);

  /* Grid of the last case that was solved; n_x n_y values of a field fit in `values`. Returns 0, or 1 where
   * no case was solved. */
  typedef struct
  {
    unsigned int n_x, n_y;
    double       element_x, element_y, x_first, y_first; /* [m] */
  } tread_half_space_grid;
  enum
  {
    TREAD_HALF_SPACE_PRESSURE = 0, /* [Pa] */
    TREAD_HALF_SPACE_SHEAR_X  = 1, /* on the wheel [Pa] */
    TREAD_HALF_SPACE_SHEAR_Y  = 2,
    TREAD_HALF_SPACE_SLIP_X   = 3, /* of the wheel over the rail, over the speed [-] */
    TREAD_HALF_SPACE_SLIP_Y   = 4,
    TREAD_HALF_SPACE_STATE    = 5 /* 0: no contact, 1: adhesion, 2: slip */
  };
  TREAD_HALF_SPACE_API int tread_half_space_get_grid(const tread_half_space *solver,
                                                     tread_half_space_grid  *grid);
  TREAD_HALF_SPACE_API int tread_half_space_get_field(const tread_half_space *solver,
                                                      int                     field,
                                                      double                 *values);

  /* Many cases on so many threads, 0: on all cores. Returns how many were not solved; their answers have the
   * status. */
  TREAD_HALF_SPACE_API size_t tread_half_space_solve_all(const tread_half_space_case *problems,
                                                         size_t                       n_problems,
                                                         unsigned int                 n_threads,
                                                         tread_half_space_answer     *answers);

  /* What the patch of a case that was solved does to the surfaces. */
  typedef struct
  {
    double friction_used;         /* tangential over normal force [-] */
    double shakedown_load_factor; /* largest pressure over the yield stress in shear, p0/k [-] */
    double surface_fatigue_index; /* friction used less k/p0 [-]; > 0: the surface ratchets */
    double t_gamma_per_area;      /* frictional work over the area in contact [Pa] */
    double regime_wear_rate; /* for each metre rolled and square metre in contact [kg/m^3], by the regimes
                              * of a wheel of R8T on a rail of 900A */
  } tread_half_space_damage;

  /* Indices of n solved cases. shear_strength: k of each [Pa]; 0 there, or no list: load factor and index are
   * NaN. All indices of a case that was not solved are NaN. */
  TREAD_HALF_SPACE_API void tread_half_space_damage_of(const tread_half_space_case   *problems,
                                                       const tread_half_space_answer *answers,
                                                       size_t                         n,
                                                       const double                  *shear_strength,
                                                       tread_half_space_damage       *damages);

#ifdef __cplusplus
}
#endif

#endif
