/* Sweeps in several processes: the same answers whatever the number of jobs, crashes as results; files that cannot be written. */
#include <dirent.h>
#include <gsl/gsl_test.h>
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <unistd.h>

#include "harness/catalogue/registry.h"
#include "harness/record/output.h"
#include "harness/record/record.h"
#include "harness/study/sweep.h"
#include "harness/study/wire.h"

enum { KILLED = 1, ENDED, HANGING };
static const case_parameter parameter[] = {{"end", "1", 0, 0, 9, NULL, "how the process of a cell ends"},
                                           {"parent", "1", 0, 0, 1e12, NULL, "the process that may build the scene"},
                                           {0}};

/* The first case of the registry in the planning process; in a cell's process, the end that is asked for. */
static status build(const double value[], scene *s, fault *f)
{
    double defaults[CASE_MAX_PARAMETERS] = {0};
    if (getpid() != (pid_t)value[1] && value[0] == KILLED)
        raise(SIGKILL);
    if (getpid() != (pid_t)value[1] && value[0] == ENDED)
        _exit(3);
    while (getpid() != (pid_t)value[1] && value[0] == HANGING)
        pause();
    parameters_default(registry_cases[0], defaults);
    return registry_cases[0]->build(defaults, s, f);
}

static const case_type crashing = {"crashing", "a case of the test", "none", parameter, build};

/* The formulation that runs on the first case. */
static formulation runner(void)
{
    formulation chosen;
    double value[CASE_MAX_PARAMETERS] = {0};
    scene s;
    char words[200];
    scene_init(&s, "test");
    parameters_default(registry_cases[0], value);
    registry_cases[0]->build(value, &s, NULL);
    int i = 0;
    while (registry_formulations[i + 1] != NULL && model_missing(&s, registry_formulations[i], words, sizeof words))
        i++;
    scene_free(&s);
    formulation_default(registry_formulations[i], &chosen);
    return chosen;
}

static void crashes(double end, int jobs, const char *reason)
{
    static const int mesh[] = {1, 2, 3};
    const double value[CASE_MAX_PARAMETERS] = {end, (double)getpid()};
    const formulation chosen = runner();
    const sweep_request request = {.jobs = jobs, .time_limit = 1};
    const status expected = end == HANGING ? STATUS_TIME_LIMIT : STATUS_FAULT;
    sweep s;
    fault f = {""};
    gsl_test(sweep_plan_one(&crashing, value, &chosen, 1, mesh, 3, &s, &f) != STATUS_OK, "planned %s", f.text);
    gsl_test(sweep_run(&request, &s, &f) != STATUS_OK, "the sweep survives %s", f.text);
    for (int i = 0; i < 3; i++)
        gsl_test(s.series[0].cell[i].solve.status != expected || strcmp(s.series[0].cell[i].solve.reason, reason) != 0,
                 "%d jobs: %s", jobs, s.series[0].cell[i].solve.reason);
    sweep_free(&s);
}

static int same_results(const sweep *a, const sweep *b)
{
    int same = a->seriess == b->seriess;
    for (int i = 0; i < a->seriess && same; i++)
        for (int k = 0; k < a->series[i].meshes && same; k++) {
            const solve_result *x = &a->series[i].cell[k].solve, *y = &b->series[i].cell[k].solve;
            same = x->status == y->status && x->quantities == y->quantities && x->steps == y->steps;
            for (int q = 0; q < x->quantities && same; q++)
                same = memcmp(&x->quantity[q].value, &y->quantity[q].value, sizeof(double)) == 0;
        }
    return same;
}

static void jobs(void)
{
    static const int mesh[] = {1, 2, 4};
    double value[CASE_MAX_PARAMETERS] = {0};
    formulation chosen[8];
    int count = 0;
    sweep s[2];
    fault f = {""};
    for (; registry_formulations[count] != NULL && count < 8; count++)
        formulation_default(registry_formulations[count], &chosen[count]);
    parameters_default(registry_cases[0], value);
    for (int i = 0; i < 2; i++) {
        const sweep_request request = {.jobs = 1 + 3 * i};
        gsl_test(sweep_plan_one(registry_cases[0], value, chosen, count, mesh, 3, &s[i], &f) != STATUS_OK ||
                     sweep_run(&request, &s[i], &f) != STATUS_OK,
                 "%d jobs %s", request.jobs, f.text);
    }
    gsl_test(sweep_cells(&s[0]) == 0, "%d cells", sweep_cells(&s[0]));
    gsl_test(!same_results(&s[0], &s[1]), "bit for bit the same with one and with four jobs");
    sweep_free(&s[0]);
    sweep_free(&s[1]);
}

/* Every truncation of a cell's bytes is noticed and leaves nothing behind. */
static void wires(void)
{
    static char bytes[1 << 20];
    double x[2] = {1, 2}, y[2] = {3, NAN};
    char first[] = "first", second[] = "", *lines[2] = {first, second};
    quantity_result quantity[2] = {{.value = 7, .curve = {2, x, y}}, {.value = NAN, .reason = "none"}};
    step_record step[3] = {{.path = 0.1}, {.path = 0.2}, {.path = 0.3}};
    const cell_result cell = {
        .left_out_lines = 2, .left_out = lines, .solve = {.quantities = 2, .quantity = quantity, .steps = 3, .step = step}};
    cell_result back;
    FILE *file = tmpfile();
    gsl_test(file == NULL || wire_write(file, &cell) != 0, "written");
    rewind(file);
    const size_t size = fread(bytes, 1, sizeof bytes, file);
    rewind(file);
    gsl_test(wire_read(file, &back) != 0 || back.solve.quantities != 2 || back.solve.quantity[0].value != 7 ||
                 back.solve.quantity[0].curve.value[0] != 3 || back.solve.step[2].path != 0.3 ||
                 strcmp(back.left_out[0], "first") != 0,
             "and read");
    cell_result_free(&back);
    fclose(file);
    int accepted = 0;
    for (size_t cut = 1; cut < size; cut += 7) {
        file = fmemopen(bytes, cut, "rb");
        accepted += wire_read(file, &back) == 0 || back.solve.quantity != NULL || back.left_out != NULL;
        fclose(file);
    }
    gsl_test_int(accepted, 0, "truncated cells that were accepted");
}

static int entries(const char *folder)
{
    int count = 0;
    DIR *d = opendir(folder);
    for (struct dirent *e = d != NULL ? readdir(d) : NULL; e != NULL; e = readdir(d))
        count += e->d_name[0] != '.';
    if (d != NULL)
        closedir(d);
    return count;
}

/* Is it there, complete, for whoever reads it? */
static int readable(const char *path, int count)
{
    hsize_t size = 0;
    double last = 0;
    const hid_t file = H5Fopen(path, H5F_ACC_RDONLY, H5P_DEFAULT), set = H5Dopen2(file, "ramp", H5P_DEFAULT),
                space = H5Dget_space(set);
    double *value = calloc((size_t)count, sizeof *value);
    if (H5Sget_simple_extent_dims(space, &size, NULL) == 1 && size == (hsize_t)count &&
        H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, value) >= 0)
        last = value[count - 1];
    free(value);
    H5Sclose(space);
    H5Dclose(set);
    H5Fclose(file);
    return last == count - 1;
}

static void write_record(const char *path, const char *folder, int good, const char *what)
{
    enum { COUNT = 10000 };
    static double ramp[COUNT];
    const hsize_t size = COUNT;
    for (int i = 0; i < COUNT; i++)
        ramp[i] = i;
    record r;
    fault f = {""};
    const int before = entries(folder);
    gsl_test(record_open(&r, &f) != STATUS_OK, "opened %s", f.text);
    H5Dclose(record_values(&r, r.file, "ramp", 1, &size, ramp, "m"));
    const status outcome = record_close(&r, path, &f);
    gsl_test(good ? outcome != STATUS_OK : outcome != STATUS_FAULT || strchr(f.text, '\n') != NULL, "%s: %s", what, f.text);
    gsl_test_int(entries(folder) - before, good, "%s: files left", what);
    gsl_test(good && !readable(path, COUNT), "%s: the file can be read", what);
}

static void write_failures(void)
{
    char folder[] = "/tmp/beamwork-sweep-XXXXXX", path[80], nowhere[80];
    gsl_test(mkdtemp(folder) == NULL, "a folder");
    snprintf(path, sizeof path, "%s/r.h5", folder);
    snprintf(nowhere, sizeof nowhere, "%s/none/r.h5", folder);
    struct rlimit kept, small;
    getrlimit(RLIMIT_FSIZE, &kept);
    small = kept;
    small.rlim_cur = 20000; /* [bytes]: as a disk that is full after that many */
    signal(SIGXFSZ, SIG_IGN);
    setrlimit(RLIMIT_FSIZE, &small);
    write_record(path, folder, 0, "no room");
    setrlimit(RLIMIT_FSIZE, &kept);
    write_record(nowhere, folder, 0, "no folder");
    write_record(folder, folder, 0, "a folder instead of a file");
    write_record(path, folder, 1, "room");
    output o;
    fault f;
    setrlimit(RLIMIT_FSIZE, &small);
    gsl_test(output_open(path, &o, &f) != STATUS_OK, "text opened");
    for (int i = 0; i < 10000; i++)
        fputs("0123456789", o.stream);
    gsl_test(output_close(&o, &f) != STATUS_FAULT, "no room for text: %s", f.text);
    setrlimit(RLIMIT_FSIZE, &kept);
    gsl_test_int(entries(folder), 1, "the file of before is still there, and nothing else");
    unlink(path);
    rmdir(folder);
}

int main(void)
{
    crashes(KILLED, 1, "crashed with signal 9");
    crashes(KILLED, 2, "crashed with signal 9");
    crashes(ENDED, 2, "its process ended with status 3");
    crashes(HANGING, 3, "time limit: no result after 1 s");
    jobs();
    wires();
    write_failures();
    return gsl_test_summary();
}
