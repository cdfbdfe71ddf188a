function finish_colors( val, opt )
% FINISH_COLORS  Colormap, range and colour bar by the options colormap and zrange of PLOT3D.

   if (is_black(opt.colormap))
      return
   end
   set_colors(opt.colormap);
   if (~isempty(opt.zrange))
      caxis(opt.zrange);
   else
      finite = val(isfinite(val));
      if (~isempty(finite) && max(finite)>min(finite))
         caxis([min(finite) max(finite)]);
      end
   end
   colorbar;

end % function finish_colors
