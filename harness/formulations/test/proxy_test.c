/* A formulation of this program is evaluated in another process, and must give bit for bit the same
 * results as in the process of the solver. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "harness/formulations/formulations.h"
#include "harness/tools/kit/cells.h"

enum { KINDS = 65536, M = ELEMENT_MAX_STRAINS, N = ELEMENT_MAX_COORDINATES };

static const element_type *served;
static element_data *kind[KINDS];
static double option[ELEMENT_MAX_OPTIONS];

static void get(void *to, size_t size, size_t count)
{
    if (fread(to, size, count, stdin) != count)
        exit(0);
}

static void names_program(void)
{
    const char *before = "";
    printf("{\"beamwork\": 1, \"name\": \"%s_proxy\", \"summary\": \"a proxy\", "
           "\"source\": \"none\", \"family\": \"%s\", \"gives\": \"e,J,H\", \"strains\": %d, "
           "\"offers\": [",
           served->name, served->family, element_strains(served, option));
    for (unsigned bit = 1; bit < FEATURE_END; bit <<= 1)
        if (served->offers & bit & ~(unsigned)(FEATURE_ENGESSER | FEATURE_HARINGX)) {
            printf("%s\"%s\"", before, feature_name(bit));
            before = ", ";
        }
    printf("]}\n");
    fflush(stdout);
}

static void learn(void)
{
    int64_t head[3];
    double first[7], numbers[111], *at = numbers;
    section *c = calloc(1, sizeof *c);
    get(head, sizeof *head, 3);
    get(first, sizeof *first, 7);
    get(numbers, sizeof *numbers, 111);
    double *const one[14] = {&c->young,    &c->shear_modulus,
                             &c->density,  &c->A,
                             &c->Iy,       &c->Iz,
                             &c->It,       &c->Iw,
                             &c->ys,       &c->zs,
                             &c->Ip,       &c->wagner_y,
                             &c->wagner_z, &c->wagner_torque};
    for (int i = 0; i < 14; i++)
        *one[i] = *at++;
    memcpy(c->D, at, sizeof c->D);
    memcpy(c->F, at + 9, sizeof c->F);
    c->axes_angle = at[18];
    memcpy(c->centroid, at + 19, sizeof c->centroid);
    c->matrices = (int)at[21];
    memcpy(c->stiffness, at + 22, sizeof c->stiffness);
    memcpy(c->mass, at + 58, sizeof c->mass);
    c->rectangle = (int)at[94];
    c->width = at[95];
    c->height = at[96];
    element_request request = {.section = c,
                               .length = first[0],
                               .features = (unsigned)head[1],
                               .options = option,
                               .type = served};
    memcpy(request.curvature, first + 1, sizeof request.curvature);
    memcpy(request.strain, first + 4, sizeof request.strain);
    free(kind[head[0]]);
    kind[head[0]] = calloc(1, served->data_size(&request));
    served->prepare(&request, kind[head[0]], NULL);
}

static void evaluate(int64_t what, int64_t count, const int64_t number[], const double body[],
                     double *out[3])
{
    const int m = element_strains(served, option), c = 2 * NODE_COORDINATES;
    const double *s = body + count * 32;
    for (int64_t i = 0; i < count; i++) {
        const element_data *d = kind[number[i]];
        if (what == 2) {
            node_state x[2] = {0};
            for (int k = 0; k < 2; k++)
                memcpy(&x[k], body + i * 32 + 16 * k, 16 * sizeof *body);
            served->strain(d, x,
                           &(strain_output){.e = out[0] ? out[0] + i * m : NULL,
                                            .J = out[1] ? out[1] + i * m * c : NULL,
                                            .s = out[2] ? s + i * m : NULL,
                                            .H = out[2] ? out[2] + i * c * c : NULL});
        } else {
            served->stress(d, body + i * m, NULL,
                           &(stress_output){.energy = out[0] ? out[0] + i : NULL,
                                            .sigma = out[1] ? out[1] + i * m : NULL,
                                            .C = out[2] ? out[2] + i * m * m : NULL});
        }
    }
}

static void reply_to(const int64_t head[4])
{
    const int64_t what = head[0], mask = head[1], count = head[2];
    const size_t m = (size_t)element_strains(served, option), c = 2 * NODE_COORDINATES,
                 each[3] = {what == 2 ? m : 1, what == 2 ? m * c : m, what == 2 ? c * c : m * m};
    int64_t *number = malloc((size_t)head[3]), reply[2] = {0, 0};
    double *out[3] = {NULL};
    get(number, 1, (size_t)head[3]);
    for (int k = 0; k < 3; k++)
        if (mask >> k & 1) {
            out[k] = malloc((size_t)count * each[k] * sizeof(double));
            reply[1] += (int64_t)((size_t)count * each[k] * sizeof(double));
        }
    evaluate(what, count, number, (const double *)(number + count), out);
    fwrite("beamwork", 1, 8, stdout);
    fwrite(reply, sizeof *reply, 2, stdout);
    for (int k = 0; k < 3; k++)
        if (out[k] != NULL)
            fwrite(out[k], sizeof(double), (size_t)count * each[k], stdout);
    for (int k = 0; k < 3; k++)
        free(out[k]);
    free(number);
    fflush(stdout);
}

static _Noreturn void serve(const char *name)
{
    static const int64_t learned[2] = {0, 0};
    served = formulations_named(name, strlen(name));
    parameter_defaults(served->options, option);
    names_program();
    for (;;) {
        char mark[8];
        int64_t head[4];
        get(mark, 1, sizeof mark);
        get(head, sizeof *head, 4);
        if (head[0] != 1) {
            reply_to(head);
            continue;
        }
        learn();
        fwrite("beamwork", 1, 8, stdout);
        fwrite(learned, sizeof *learned, 2, stdout);
        fflush(stdout);
    }
}

static void compare(const char *case_name, const char *name, int elements)
{
    const case_type *type = case_find(case_name, NULL);
    char proxy[80];
    cell_result here, there;
    fault f = {""};
    snprintf(proxy, sizeof proxy, "%s_proxy", name);
    const cell_request mine = cells_of(type, name, elements),
                       other = cells_of(type, proxy, elements);
    gsl_test(cell_run(&mine, &here, &f) != STATUS_OK, "%s, %s: %s", case_name, name, f.text);
    gsl_test(cell_run(&other, &there, &f) != STATUS_OK, "%s, %s: %s", case_name, proxy, f.text);
    gsl_test_int(there.solve.quantities, here.solve.quantities, "%s: quantities", case_name);
    for (int i = 0; i < here.solve.quantities; i++) {
        const double a = here.solve.quantity[i].value, b = there.solve.quantity[i].value;
        /* the protocol does not pass the stresses of the iteration, which beamw uses */
        const double apart = strcmp(name, "beamw") == 0 ? 1e-14 : 0;
        gsl_test(!(fabs(a - b) <= apart * fabs(a)) || signbit(a) != signbit(b),
                 "%s, %s, %s: %.17g, in another process %.17g", case_name, name,
                 here.scene.quantity[i].name, a, b);
    }
    gsl_test(here.counters.iterations != there.counters.iterations ||
                 here.counters.strain_evaluations != there.counters.strain_evaluations ||
                 here.counters.stress_evaluations != there.counters.stress_evaluations,
             "%s, %s: the same work is counted", case_name, name);
    cell_result_free(&here);
    cell_result_free(&there);
}

static void load(const char *program, const char *name)
{
    const element_type *type;
    char command[4300];
    fault f = {""};
    snprintf(command, sizeof command, "exec:'%s' %s", program, name);
    gsl_test(plugin_load(command, &type, &f) != STATUS_OK ||
                 formulations_add(type, NULL, &f) != STATUS_OK || !process_serves(type),
             "%s in another process: %s", name, f.text);
}

int main(int count, char **arguments)
{
    char self[4200];
    if (count == 2)
        serve(arguments[1]);
    const ssize_t length = readlink("/proc/self/exe", self, sizeof self - 1);
    self[length > 0 ? length : 0] = '\0';
    load(self, "sheet_third");
    load(self, "beamw");
    compare("sheet_cantilever", "sheet_third", 1);
    compare("sheet_cantilever", "sheet_third", 4);
    compare("elastica", "sheet_third", 3);
    compare("c_cantilever", "beamw", 4);
    compare("tapered_cantilever", "beamw", 3);
    return gsl_test_summary();
}
