package redbee.spy;

import java.awt.Color;
import java.awt.Dimension;
import java.awt.Graphics;
import java.awt.image.BufferedImage;
import java.util.function.Supplier;
import javax.swing.JPanel;
import javax.swing.Timer;

/** Shows the newest image of a channel, ten times a second, as large as there is room. */
final class ImagePanel extends JPanel {
  private static final int PERIOD_MS = 100;
  private static final int CAPTION_PX = 18;

  private final Supplier<Object> newest;
  private Object shown;
  private BufferedImage image;

  ImagePanel(Supplier<Object> newest) {
    this.newest = newest;
    setPreferredSize(new Dimension(640, 480 + CAPTION_PX));
    setBackground(Color.DARK_GRAY);
    new Timer(PERIOD_MS, tick -> refresh()).start();
  }

  private void refresh() {
    Object message = newest.get();
    if (message == null || message == shown || !isShowing()) return;
    shown = message;
    image = Images.of(message);
    repaint();
  }

  @Override
  protected void paintComponent(Graphics g) {
    super.paintComponent(g);
    g.setColor(Color.WHITE);
    g.drawString(shown == null ? "no message yet" : Images.captionOf(shown), 6, 13);
    if (image == null) return;
    int room = Math.max(1, getHeight() - CAPTION_PX);
    double scale = Math.min(getWidth() / (double) image.getWidth(), room / (double) image.getHeight());
    g.drawImage(image, 0, CAPTION_PX, (int) (image.getWidth() * scale), (int) (image.getHeight() * scale), null);
  }
}
