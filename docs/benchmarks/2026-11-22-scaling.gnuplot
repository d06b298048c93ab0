set terminal svg size 800,500 dynamic background rgb 'white'
set output '2026-11-22-scaling.svg'
set datafile separator ','
set logscale x
set format x '10^{%L}'
set key top left
set xlabel 'triangles'
set ylabel 'ns per ray'
set yrange [0:*]
set title 'cost of a ray, bvh4b, llvmpipe (LLVM 15.0.6, 256 bits)' noenhanced
plot '2026-11-22-scaling.csv' using (strcol(1) eq 'primary' ? $2 : NaN):3:4:5 with yerrorbars pointtype 7 linecolor 1 title 'primary', -31.7124 + 13.677 * log(x) / log(2) linecolor 1 title '-31.7 + 13.7 log_2 n, R^2 = 0.96', \
  '2026-11-22-scaling.csv' using (strcol(1) eq 'diffuse' ? $2 : NaN):3:4:5 with yerrorbars pointtype 7 linecolor 2 title 'diffuse', -470.192 + 67.1314 * log(x) / log(2) linecolor 2 title '-470 + 67.1 log_2 n, R^2 = 0.972'
