#!/bin/sh
# Plants one fault at a time into a copy of the project; 'verify' must notice each with the right exit code.
# Ends in one line: N killed, M survived. Survivors are listed.
set -u
here=$(pwd)
work=${1:-build/mutants}
killed=0 survived=0
rm -rf "$work"
mkdir -p "$work/base"
git ls-files | tar -cf - -T - | tar -xf - -C "$work/base"
make -s -C "$work/base" -j2 CFLAGS="-O1" all >"$work/base.log" 2>&1 || { tail "$work/base.log"; exit 1; }

verdict() { # name expected status
    if [ "$3" = "$2" ]; then
        killed=$((killed + 1))
        printf 'killed    %-58s exit %s\n' "$1" "$3"
    else
        survived=$((survived + 1))
        printf 'SURVIVED  %-58s exit %s, expected %s\n' "$1" "$3" "$2"
    fi
}
# plant NAME FILE SED-EXPRESSION EXPECTED-EXIT [verify arguments]
plant() {
    name=$1 file=$2 change=$3 expected=$4
    shift 4
    cp -p "$work/base/$file" "$work/saved"
    sed -i -E "$change" "$work/base/$file"
    if cmp -s "$work/saved" "$work/base/$file"; then
        verdict "$name (not planted: nothing matched)" planted none
        return
    fi
    touch "$work/base/$file"
    if make -s -C "$work/base" -j2 CFLAGS="-O1" all >"$work/log" 2>&1; then
        (cd "$work/base" && timeout 600 build/beamwork verify -j 2 "$@") >"$work/log" 2>&1
        verdict "$name" "$expected" $?
    else
        verdict "$name (refused by the build)" built built
    fi
    cp -p "$work/saved" "$work/base/$file"
    touch "$work/base/$file"
}
plant "1 % of bending stiffness" elements/beamw/stiffness.c 's|E \* c->Iz / l3|1.01 * E * c->Iz / l3|' 1
plant "sign of D_zw" elements/section/walls.c 's|: out->F\[3 \* i \+ j\] / \(inertia|: (i + j == 3 ? -1 : 1) * out->F[3 * i + j] / (inertia|' 1
plant "sign of u_y in N Eq. 49" elements/sheet_third.c 's|third_prepare\(request, 0|third_prepare(request, 1|' 1
plant "missing second-order term" elements/beamw/modified.c 's|\{2, 4, 5, 1\}|{2, 4, 5, 0}|' 1
plant "wrong lumped mass" elements/beamw/inertia.c 's|rho \* d->l0 / 2|rho * d->l0 / 2.02|' 1
plant "wrong consistent mass" elements/beamw/inertia.c 's|weight\[point / 2\] / 2 \* l|weight[point / 2] / 2.02 * l|' 1
plant "transposed compliance" harness/solve/compliance.c 's|C\[6 \* component\[i\] \+ component\[j\]\] = A|C[6 * component[j] + component[i]] = A|' 1
plant "sign of the dead moment's stiffness" harness/solve/compliance.c 's|-= skew\[|+= skew[|' 1
plant "a formulation that returns NaN" elements/beamw/forms.c 's|(dense_add_transpose_mul\(8, 8, 1, B, conjugate, out->sigma\);)|\1 out->sigma[1] = NAN;|' 1
plant "a solver that never converges" harness/solve/static.c 's|correction <= n->criterion|correction < 0|' 1
plant "an eigenvalue taken for its neighbour" harness/solve/extract.c 's|\[q->order\]|[q->order + 1]|' 1
plant "tolerance in the wrong unit" cases/c_column.c 's|tolerance = 1e-5|tolerance = 1e+1|' 1
plant "stale truth" reference/defaults.csv 's|^c_column,length,6,|c_column,length,6.1,|' 4
plant "truth of other parameters" reference/tables/c_column.csv 's|^c_column,length=3,,,buckling_load,|c_column,length=3.1,,,buckling_load,|' 1
plant "a finding deleted from the ledger" reference/findings.csv '/^c_column,section_data=printed,beamw,buckling_load/d' 1
(cd "$work/base" && make -s -j2 CFLAGS="-O1" all >/dev/null 2>&1 && build/beamwork verify -k no_such_thing) >"$work/log" 2>&1
verdict "empty selection" 3 $?
head -c 20000 "$work/base/build/truths.h5" >"$work/cut.h5"
"$work/base/build/beamwork" verify --truths "$here/$work/cut.h5" >"$work/log" 2>&1
verdict "truncated truths" 4 $?
rm -rf "$work"
echo "$killed killed, $survived survived"
[ $survived = 0 ]
