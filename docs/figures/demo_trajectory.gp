# Top view of the demo's drive. Repeat with:
#   bash apps/demo.sh && gnuplot docs/figures/demo_trajectory.gp      (package gnuplot-nox)
set terminal svg size 900,420 font "sans,14" background "white"
set output "docs/figures/demo_trajectory.svg"
set title "Simulated drive of the demo, top view: camera trajectory in metres, nothing aligned"
set xlabel "right of the start [m]"
set ylabel "ahead of the start [m]"
set size ratio -1
set grid
set key left top
plot "demo/drive/poses.txt" using 4:12 with lines lw 6 lc rgb "#c8c8c8" title "true poses", \
     "demo/result/trajectory_camera.kitti" using 4:12 with lines lw 2 lc rgb "#0060a0" title "oneac"
