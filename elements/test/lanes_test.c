/* Strains and stresses of many elements at once have the bits of one at a time, with and without
 * AVX2. */
#include "elements/beamw/lanes.h"
#include "elements/collocation/lanes.h"
#include "elements/sheet/lanes.h"
#include "elements/test/lanes_batch.h"

extern const element_type element_beamw, element_beamw_vlasov, element_beamw_first,
    element_beamw_consistent;
extern const element_type element_sheet_second, element_sheet_second_consistent,
    element_sheet_third, element_sheet_third_printed, element_collocation,
    element_geometrically_exact;

typedef void strains_function(int count, const element_data *const data[], const node_state x[],
                              strain_output out[]);
typedef void stresses_function(int count, const element_data *const data[], const double *const e[],
                               const double *const inner[], stress_output out[], status outcome[]);

/* What a family exports beside the functions that its types choose for the processor. */
static const struct {
    const element_type *type;
    strains_function *strain;
    stresses_function *stress;
    double option[3]; /* the first ones */
} lanes_family[] = {
    {&element_beamw, beamw_lanes_modes_plain, beamw_lanes_modified_plain, {0}},
    {&element_beamw_vlasov, beamw_lanes_modes_plain, beamw_lanes_modified_plain, {0}},
    {&element_beamw_first, beamw_lanes_modes_plain, beamw_lanes_modified_plain, {0}},
    {&element_beamw_consistent, beamw_lanes_helicoidal_plain, beamw_lanes_consistent_plain, {0}},
    {&element_beamw_consistent,
     beamw_lanes_helicoidal_plain,
     beamw_lanes_consistent_plain,
     {0, 0, 1}},
    {&element_beamw_consistent,
     beamw_lanes_helicoidal_plain,
     beamw_lanes_consistent_plain,
     {0, 1, 1}},
    {&element_sheet_second, sheet_lanes_strain_plain, sheet_lanes_second_plain, {0}},
    {&element_sheet_second_consistent, sheet_lanes_strain_plain, sheet_lanes_second_plain, {0}},
    {&element_sheet_third, sheet_lanes_strain_plain, sheet_lanes_third_plain, {0}},
    {&element_sheet_third_printed, sheet_lanes_strain_plain, sheet_lanes_third_plain, {0}},
    {&element_collocation, exact_lanes_stages_strain_plain, exact_lanes_stages_stress_plain, {2}},
    {&element_collocation, exact_lanes_stages_strain_plain, exact_lanes_stages_stress_plain, {5}},
    {&element_geometrically_exact,
     exact_lanes_gauss_strain_plain,
     exact_lanes_gauss_stress_plain,
     {0}},
    {&element_geometrically_exact,
     exact_lanes_gauss_strain_plain,
     exact_lanes_gauss_stress_plain,
     {1}},
};

/* The strains wanted: e, J and H by the bits of what. */
static strain_output strain_of(const batch *b, int k, answers *a, int what)
{
    return (strain_output){.e = what & 1 ? a->e : NULL,
                           .J = what & 2 ? a->J : NULL,
                           .s = what & 4 ? b->weight[k] : NULL,
                           .H = what & 4 ? a->H : NULL};
}

static stress_output stress_of(const batch *b, answers *a, int what)
{
    return (stress_output){.energy = what & 1 ? &a->energy : NULL,
                           .sigma = what & 2 ? a->sigma : NULL,
                           .C = what & 4 ? a->C : NULL,
                           .residual = what & 1 ? &a->residual : NULL,
                           .memory = what & 4 && b->type->memory != NULL ? a->memory : NULL};
}

/* Elements [first, first + count) at once. */
static void strains(batch *b, strains_function *many, int first, int count, int what)
{
    strain_output out[MANY];
    answers together[MANY], alone;
    int different = 0;
    memset(together, 0, sizeof together);
    for (int k = 0; k < count; k++)
        out[k] = strain_of(b, first + k, &together[k], what);
    many(count, b->data + first, b->x + first * b->nodes, out);
    for (int k = 0; k < count; k++) {
        memset(&alone, 0, sizeof alone);
        strain_output one = strain_of(b, first + k, &alone, what);
        b->type->strain(b->data[first + k], b->x + (first + k) * b->nodes, &one);
        different += memcmp(&alone, &together[k], sizeof alone) != 0;
    }
    gsl_test_int(different, 0, "%s: elements of other strains, %d at once, wanted %d", b->name,
                 count, what);
}

static void stresses(batch *b, stresses_function *many, int first, int count, int what)
{
    stress_output out[MANY];
    const double *e[MANY] = {NULL}, *inner[MANY];
    status outcome[MANY];
    answers together[MANY], alone;
    int different = 0;
    memset(together, 0, sizeof together);
    for (int k = 0; k < count; k++) {
        out[k] = stress_of(b, &together[k], what);
        e[k] = b->alone[first + k].e;
        inner[k] = b->inner[first + k];
    }
    many(count, b->data + first, e, inner, out, outcome);
    for (int k = 0; k < count; k++) {
        memset(&alone, 0, sizeof alone);
        stress_output one = stress_of(b, &alone, what);
        const status ended = b->type->stress(b->data[first + k], e[k], inner[k], &one);
        different += ended != outcome[k] ||
                     (ended == STATUS_OK && memcmp(&alone, &together[k], sizeof alone) != 0);
    }
    gsl_test_int(different, 0, "%s: elements of other stresses, %d at once, wanted %d", b->name,
                 count, what);
}

static void lanes_compare(batch *b, strains_function *strain, stresses_function *stress)
{
    for (int what = 1; what < 8; what++)
        for (int count = 1; count <= MANY; count++)
            for (int first = 0; first + count <= MANY; first += 3) {
                if (strain != NULL)
                    strains(b, strain, first, count, what);
                if (stress != NULL)
                    stresses(b, stress, first, count, what);
            }
}

int main(void)
{
    for (size_t i = 0; i < sizeof lanes_family / sizeof lanes_family[0]; i++)
        for (int k = 0; k < BATCH_FEATURES; k++) {
            batch b = batch_of(lanes_family[i].type, lanes_family[i].option, 3, k);
            lanes_compare(&b, b.type->strain_many, b.type->stress_many);
            b.name = "without AVX2";
            lanes_compare(&b, lanes_family[i].strain, lanes_family[i].stress);
            batch_free(&b);
        }
    return gsl_test_summary();
}
