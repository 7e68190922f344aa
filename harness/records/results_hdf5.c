/* Reading results.h5 back. Nothing is believed: a file may be foreign, cut short or damaged. */
#include <stdlib.h>
#include <string.h>

#include "harness/formulations/formulations.h"

#include "harness/records/kept.h"
#include "harness/records/results_case.h"
#include "harness/records/results_sweep.h"
#include "harness/records/table_reader.h"
#include "harness/study/study.h"

enum { HDF5_NAME = 200 };

static status read_case(const char *path, hid_t cases, const char *name, stored_results *out,
                        fault *f)
{
    const hid_t here = H5Gopen2(cases, name, H5P_DEFAULT);
    if (here < 0)
        return results_case_damaged(path, "", name, f);
    const status outcome = results_case_read(path, here, name, out, f);
    H5Gclose(here);
    return outcome;
}

static status read_cases(const char *path, hid_t cases, stored_results *out, fault *f)
{
    char name[HDF5_NAME];
    H5G_info_t info = {0};
    if (H5Gget_info(cases, &info) < 0)
        return results_case_damaged(path, "", "cases", f);
    for (hsize_t i = 0; i < info.nlinks; i++) {
        if (H5Lget_name_by_idx(cases, ".", H5_INDEX_NAME, H5_ITER_INC, i, name, sizeof name,
                               H5P_DEFAULT) <= 0)
            return results_case_damaged(path, "", "cases", f);
        TRY(read_case(path, cases, name, out, f));
    }
    return STATUS_OK;
}

static status hdf5_read_tables(const char *path, hid_t at, stored_results *out, fault *f)
{
    const hid_t cases = H5Gopen2(at, "cases", H5P_DEFAULT);
    const status outcome =
        cases < 0 ? results_case_damaged(path, "", "cases", f) : read_cases(path, cases, out, f);
    out->whole = 1;
    if (cases >= 0)
        H5Gclose(cases);
    return outcome;
}

/* A text attribute as a copy, NULL where it is not there; 0: out of memory. */
static int read_text(hid_t file, const char *name, char **out)
{
    enum { MOST = 1 << 16 };
    char *room = malloc(MOST);
    *out = NULL;
    if (room != NULL && table_reader_attribute_text(file, name, room, MOST) && room[0] != '\0')
        *out = strdup(room);
    const int good = room != NULL && (*out != NULL || H5Aexists(file, name) <= 0);
    free(room);
    return good;
}

typedef struct declared_row {
    char formulation[FORMULATION_KEY];
    signed char is_new;
} declared_row;

/* Keys of formulations that do not gate; files that declare none have none. */
static status read_fresh(const char *path, hid_t file, results_part *out, fault *f)
{
    static const table_column columns[] = {
        {"formulation", FIELD_TEXT, offsetof(declared_row, formulation), FORMULATION_KEY},
        {"is_new", FIELD_FLAG, offsetof(declared_row, is_new), 0}};
    void *rows;
    if (H5Lexists(file, "declarations", H5P_DEFAULT) <= 0)
        return STATUS_OK;
    const int count =
        table_reader_rows(file, "declarations", 2, columns, sizeof(declared_row), &rows);
    const declared_row *row = rows;
    size_t size = 0;
    FILE *to = count >= 0 ? open_memstream(&out->fresh, &size) : NULL;
    for (int i = 0; to != NULL && i < count; i++)
        if (row[i].is_new)
            fprintf(to, "%s%s", ftell(to) > 0 ? "\n" : "", row[i].formulation);
    const int good = to != NULL && fclose(to) == 0;
    free(rows);
    return good ? STATUS_OK : results_case_damaged(path, "", "declarations", f);
}

static status read_part(const char *path, hid_t file, results_part *out, fault *f)
{
    if (!read_text(file, "selection", &out->select) ||
        !read_text(file, "selection_cases", &out->cases) ||
        !read_text(file, "selection_formulations", &out->formulations))
        return results_case_damaged(path, "", "selection", f);
    if (out->select != NULL && select_matches(out->select, "") < 0)
        return results_case_damaged(path, "", "selection", f);
    return read_fresh(path, file, out, f);
}

static status check_version(const char *path, hid_t file, fault *f)
{
    char schema[64];
    long version = 0;
    if (H5Aexists(file, KEPT_SWEEP_MARK) > 0)
        return STATUS_OK;
    if (!table_reader_attribute_text(file, "schema", schema, sizeof schema) ||
        strcmp(schema, SCHEMA_NAME) != 0 ||
        !table_reader_attribute_count(file, "schema_version", &version))
        return fault_set(f, STATUS_FAULT,
                         "%.120s: not a file of results; write one with 'beamwork verify -o' or "
                         "'beamwork sweep -o'",
                         path);
    if (version >= SCHEMA_OLDEST && version <= SCHEMA_VERSION)
        return STATUS_OK;
    return fault_set(f, STATUS_FAULT,
                     "%.120s: results of version %ld, this program reads %d to %d; run "
                     "'beamwork verify -o' again",
                     path, version, SCHEMA_OLDEST, SCHEMA_VERSION);
}

/* Where an experiment of that name has left what is there; -1. The root is that of verify, or of a
 * sweep that had the file for itself. */
static hid_t open_group(hid_t file, const char *name)
{
    const int is_sweep = strcmp(name, KEPT_SWEEP) == 0, is_own = strcmp(name, "verify") == 0;
    if (is_sweep && H5Aexists(file, KEPT_SWEEP_MARK) > 0)
        return H5Gopen2(file, "/", H5P_DEFAULT);
    if (is_own)
        return H5Lexists(file, "cases", H5P_DEFAULT) > 0 ? H5Gopen2(file, "/", H5P_DEFAULT) : -1;
    const hid_t all = H5Lexists(file, KEPT_GROUPS, H5P_DEFAULT) > 0
                          ? H5Gopen2(file, KEPT_GROUPS, H5P_DEFAULT)
                          : -1,
                own = all >= 0 && H5Lexists(all, name, H5P_DEFAULT) > 0
                          ? H5Gopen2(all, name, H5P_DEFAULT)
                          : -1;
    handles_close(1, &all);
    return own;
}

static status read_group(const char *path, hid_t at, stored_results *out, fault *f)
{
    if (H5Aexists(at, KEPT_SWEEP_MARK) > 0)
        return results_sweep_read(path, at, out, f);
    TRY(read_part(path, at, &out->part, f));
    return hdf5_read_tables(path, at, out, f);
}

static status read_file(const char *path, const char *experiment, hid_t file, stored_results *out,
                        fault *f)
{
    static const char *const of_cells[] = {"verify", "bench", KEPT_SWEEP};
    hid_t at = -1;
    TRY(check_version(path, file, f));
    for (size_t i = 0; i < sizeof of_cells / sizeof *of_cells && at < 0; i++)
        if (experiment == NULL || strcmp(experiment, of_cells[i]) == 0)
            at = open_group(file, of_cells[i]);
    if (at < 0)
        return experiment == NULL ? results_case_damaged(path, "", "cases", f)
                                  : fault_set(f, STATUS_FAULT,
                                              "%.120s: nothing of '%.40s' is there that could be "
                                              "compared; verify, bench and sweep leave such",
                                              path, experiment);
    const status outcome = read_group(path, at, out, f);
    H5Gclose(at);
    return outcome;
}

status results_hdf5_read(const char *path, const char *experiment, stored_results *out, fault *f)
{
    TRY(checksum_check(path, f));
    H5Eset_auto2(H5E_DEFAULT, NULL, NULL);
    const hid_t file = H5Fopen(path, H5F_ACC_RDONLY, H5P_DEFAULT);
    if (file < 0)
        return fault_set(f, STATUS_FAULT,
                         "%.120s: cannot be read as HDF5; run 'beamwork verify -o' again", path);
    const status outcome = read_file(path, experiment, file, out, f);
    H5Fclose(file);
    return outcome;
}
