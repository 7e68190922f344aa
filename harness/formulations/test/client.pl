# A formulation written from protocol.md alone, in another language than the example in it: strains, and stresses that
# are requested because `prepare` answers without C. One option scales the torsion constant.
use strict;
use warnings;

binmode STDIN;
binmode STDOUT;
$| = 1;
print '{"beamwork": 1, "name": "perl_beam", "summary": "two nodes, one point", "source": "none",'
    . ' "family": "example", "gives": "e", "strains": 6, "order": {"statics": [2, 4]},'
    . ' "offers": ["shear", "geometric", "large rotations", "mass", "rotary inertia"],'
    . ' "shear_theories": ["haringx"], "limits": ["doubly symmetric"],'
    . ' "options": [{"name": "torsion", "default": 1, "min": 0.1, "max": 10, "unit": "1",'
    . ' "summary": "factor of It"}]}' . "\n";

sub take {
    my ($count) = @_;
    my $data = '';
    while (length($data) < $count) {
        my $more = read(STDIN, $data, $count - length($data), length($data));
        exit 0 if !$more;
    }
    return $data;
}

sub dot { my ($a, $b) = @_; my $s = 0; $s += $a->[$_] * $b->[$_] for 0 .. 2; return $s }

sub strains {
    my ($l, @x) = @_;
    my @chord = map { $x[16 + $_] - $x[$_] } 0 .. 2;
    # The columns of R, which is row-major, are the axes of the nodes.
    my @p = map { my $j = $_; [map { $x[6 + 3 * $_ + $j] } 0 .. 2] } 0 .. 2;
    my @q = map { my $j = $_; [map { $x[22 + 3 * $_ + $j] } 0 .. 2] } 0 .. 2;
    my @axis = map { my ($i, $k) = (($_ + 1) % 3, ($_ + 2) % 3);
                     (dot($p[$k], $q[$i]) - dot($p[$i], $q[$k])) / 2 } 0 .. 2;
    my $sine = sqrt(dot(\@axis, \@axis));
    my $angle = atan2($sine, (dot($p[0], $q[0]) + dot($p[1], $q[1]) + dot($p[2], $q[2]) - 1) / 2);
    my @psi = map { $sine > 0 ? $_ * $angle / $sine : $_ } @axis;
    my @at_p = map { dot($_, \@chord) } @p;
    my @at_q = map { dot($_, \@chord) } @q;
    my $c = cos($angle / 2);
    my $along = $angle > 0 ? (1 - 1 / $c) / $angle**2 * dot(\@psi, \@at_p) : 0;
    my @d = map { ($at_p[$_] + $at_q[$_]) / (2 * $c) + $along * $psi[$_] } 0 .. 2;
    return ($d[0] - $l, @d[1, 2], map { $l * $_ } @psi);
}

my (%length, %stiffness);
while (1) {
    my ($mark, $what, $mask, $count, $bytes) = unpack 'a8q<4', take(40);
    my $body = take($bytes);
    my @numbers;
    if ($what == 1) {
        my ($kind, $features, $options) = unpack 'q<3', $body;
        my ($l, @rest) = unpack 'd<*', substr($body, 24);
        my @s = @rest[6 .. 116];
        my $torsion = $rest[117];
        my $shear = $features & 2 ? $l / $s[1] : 0;
        $length{$kind} = $l;
        $stiffness{$kind} = [
            $s[0] * $s[3] / $l, 1 / ($shear * $s[23] + $l**3 / (12 * $s[0] * $s[5])),
            1 / ($shear * $s[27] + $l**3 / (12 * $s[0] * $s[4])),
            $torsion * $s[1] * $s[6] / $l**3, $s[0] * $s[4] / $l**3, $s[0] * $s[5] / $l**3
        ];
    } elsif ($what == 2) {
        my @kinds = unpack "q<$count", $body;
        my @x = unpack 'd<*', substr($body, 8 * $count);
        push @numbers, strains($length{$kinds[$_]}, @x[32 * $_ .. 32 * $_ + 31]) for 0 .. $count - 1;
    } else {
        my @kinds = unpack "q<$count", $body;
        my @e = unpack 'd<*', substr($body, 8 * $count);
        my (@energy, @sigma, @C);
        for my $i (0 .. $count - 1) {
            my $k = $stiffness{$kinds[$i]};
            my @s = map { $k->[$_] * $e[6 * $i + $_] } 0 .. 5;
            my $energy = 0;
            $energy += $s[$_] * $e[6 * $i + $_] / 2 for 0 .. 5;
            push @energy, $energy;
            push @sigma, @s;
            for my $row (0 .. 5) { push @C, map { $_ == $row ? $k->[$row] : 0 } 0 .. 5 }
        }
        @numbers = (($mask & 1 ? @energy : ()), ($mask & 2 ? @sigma : ()), ($mask & 4 ? @C : ()));
    }
    print pack('a8q<2', 'beamwork', 0, 8 * @numbers), pack('d<*', @numbers);
}
