package redbee.spy;

import java.awt.event.ActionEvent;
import javax.swing.AbstractAction;
import javax.swing.Action;
import javax.swing.JDesktopPane;
import javax.swing.JInternalFrame;
import lcm.spy.ChannelData;
import lcm.spy.SpyPlugin;

/** lcm-spy finds this on its class path: a double click on a channel with pictures opens them. */
public final class PicturePlugin implements SpyPlugin {
  @Override
  public boolean canHandle(long fingerprint) {
    return Pictures.isPicture(fingerprint);
  }

  @Override
  public Action getAction(JDesktopPane desktop, ChannelData channel) {
    return new AbstractAction("Pictures") {
      @Override
      public void actionPerformed(ActionEvent event) {
        JInternalFrame frame = new JInternalFrame(channel.name, true, true, true, true);
        frame.add(new PicturePanel(() -> channel.last));
        frame.pack();
        frame.setVisible(true);
        desktop.add(frame);
      }
    };
  }
}
