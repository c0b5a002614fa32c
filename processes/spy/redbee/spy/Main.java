package redbee.spy;

import java.awt.Dimension;
import java.awt.Point;
import java.awt.Toolkit;
import java.io.IOException;
import java.util.concurrent.atomic.AtomicReference;
import javax.swing.JFrame;
import javax.swing.SwingUtilities;
import lcm.lcm.LCM;
import lcm.lcm.LCMDataInputStream;
import redbee.foreground_t;
import redbee.image_t;

/** Main LCM_URL [CHANNEL...]: lcm-spy, and a window for the images of each of the channels. */
public final class Main {
  private Main() {}

  public static void main(String[] arguments) {
    String url = arguments[0];
    lcm.spy.Spy.main(new String[] {"--lcm-url=" + url});
    for (int i = 1; i < arguments.length; ++i) show(url, arguments[i], i - 1);
  }

  private static void show(String url, String channel, int number) {
    AtomicReference<Object> newest = new AtomicReference<>();
    try {
      new LCM(url).subscribe(channel, (lcm, name, data) -> take(data, newest));
    } catch (IOException unreachable) {
      System.err.println("spy: " + unreachable.getMessage());
      System.exit(1);
    }
    SwingUtilities.invokeLater(() -> {
      JFrame frame = new JFrame(channel);
      frame.add(new ImagePanel(newest::get));
      frame.pack();
      frame.setLocation(besideTheTable(frame, number));
      frame.setVisible(true);
    });
  }

  // As far as the screen has room: right of the spy's own window, one below the other.
  private static Point besideTheTable(JFrame frame, int number) {
    final int tableWidth = 810; // lcm-spy's 800, and a frame
    Dimension screen = Toolkit.getDefaultToolkit().getScreenSize();
    int x = Math.max(0, Math.min(tableWidth, screen.width - frame.getWidth()));
    int rows = Math.max(1, screen.height / frame.getHeight());
    return new Point(x, number % rows * frame.getHeight());
  }

  private static void take(LCMDataInputStream data, AtomicReference<Object> newest) {
    try {
      long fingerprint = data.readLong();
      data.reset();
      if (fingerprint == image_t.LCM_FINGERPRINT) newest.set(new image_t(data));
      if (fingerprint == foreground_t.LCM_FINGERPRINT) newest.set(new foreground_t(data));
    } catch (IOException | RuntimeException damaged) {
      // lcm-spy's own table counts it as undecodable.
    }
  }
}
