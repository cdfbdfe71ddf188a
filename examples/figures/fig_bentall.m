% Aluminium on steel: tractions of the braked and the driven aluminium roller
for i = 1 : 2
   subplot(1, 2, i);
   s = loadcase('bentall', 4+i);
   opt = plot2d;
   opt.negpn = 0;
   opt.facpt = -1;                      % on the lower roller
   opt.pt_linestyle = '-';
   opt.xlim  = [-0.11 0.11];
   plot2d(s, opt);
end
