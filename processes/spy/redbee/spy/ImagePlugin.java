package redbee.spy;

import java.awt.event.ActionEvent;
import javax.swing.AbstractAction;
import javax.swing.Action;
import javax.swing.JDesktopPane;
import javax.swing.JInternalFrame;
import lcm.spy.ChannelData;
import lcm.spy.SpyPlugin;

/** lcm-spy finds this on its class path: a double click on a channel with images opens them. */
public final class ImagePlugin implements SpyPlugin {
  @Override
  public boolean canHandle(long fingerprint) {
    return Images.isImage(fingerprint);
  }

  @Override
  public Action getAction(JDesktopPane desktop, ChannelData channel) {
    return new AbstractAction("Images") {
      @Override
      public void actionPerformed(ActionEvent event) {
        JInternalFrame frame = new JInternalFrame(channel.name, true, true, true, true);
        frame.add(new ImagePanel(() -> channel.last));
        frame.pack();
        frame.setVisible(true);
        desktop.add(frame);
      }
    };
  }
}
